/** Reading and writing project files (docs/FORMAT.md). */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import type { SchemaProblem } from "../calls/schemas.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic, printable } from "../diagnostics/package-diagnostic.js";
import type { ReadError, ReadResult } from "../diagnostics/read-error.js";
import { truncatedAt } from "../formats/read-result.js";
import { parsedProject } from "./schema.js";
import {
  type Project,
  PROJECT_FORMAT,
  type ProjectBackground,
  type ProjectProblem,
} from "./project-types.js";
import { PROJECT_VERSION, upgraded } from "./versions.js";

/** Largest number of reported errors; the first ones usually cause the rest. */
const MAX_ERRORS = 20;

/**
 * Checks that a value is a project: structure, finite numbers, unique ids, references that exist. Upgrades projects of
 * earlier versions. Does not check the geometry; `previewProject` and `meshProject` do. Never throws.
 */
export function parseProject(value: unknown): ReadResult<Project> {
  return checkedProject(upgraded(value));
}

/** As `parseProject`, for values that must already have the current version. */
export function checkedProject(value: unknown): ReadResult<Project> {
  const headProblem = checkHead(value);
  if (headProblem !== undefined) return refused(headProblem);
  const parsed = parsedProject(value);
  if ("value" in parsed) return { success: true, value: parsed.value };
  const [first, ...rest] = parsed.problems.slice(0, MAX_ERRORS).map(invalidProject);
  return refused(first ?? notAProject("it does not follow the schema"), ...rest);
}

/** Reads the text of a project file. Never throws. */
export function readProject(text: string): ReadResult<Project> {
  if (typeof text !== "string") return refused(notAProject("it is no text"));
  if (text.trim() === "") {
    return refused({ ...notAProject("the file is empty"), code: "empty-file" });
  }
  let value: unknown;
  try {
    value = JSON.parse(text.startsWith("\uFEFF") ? text.slice(1) : text);
  } catch (failure) {
    return refused(describeSyntaxError(text, failure));
  }
  return parseProject(value);
}

function refused(...errors: [ReadError, ...ReadError[]]): ReadResult<never> {
  const [first, ...rest] = errors;
  const shown = (error: ReadError) => ({ ...error, message: printable(error.message) });
  return { success: false, errors: [shown(first), ...rest.map(shown)] };
}

/**
 * Returns the text of a project file: JSON with one entity per line, so that versions of a model can be compared
 * line by line. Throws a `MesherError` if the project cannot be written. Use `parseProject` to check that it can
 * be read again.
 */
export function writeProject(project: Project): string {
  checkArgument("project", project, writableProject);
  try {
    return projectText(project);
  } catch (failure) {
    // JSON cannot store circular references and BigInt values.
    const remedy = "Pass a project without circular references or BigInt values.";
    if (failure instanceof TypeError) {
      refuse([
        packageDiagnostic("invalid-argument", `project cannot be written: ${failure.message}`, remedy),
      ]);
    }
    throw failure;
  }
}

function projectText(project: Project): string {
  const { points, lines, patches, bodies, background, groups, parameters, expressions, problem, ...rest } =
    project;
  const { $schema, format, version, name, description, units, meshing } = rest;
  const head = Object.entries({ $schema, format, version, name, description, units, meshing })
    .filter(([, value]) => value !== undefined)
    .map(([key, value]) => `  ${JSON.stringify(key)}: ${JSON.stringify(value)}`);
  const listText = (key: string, list: readonly unknown[] | undefined) =>
    list === undefined ? [] : [`  "${key}": ${rows(list, "  ")}`];
  const body = [
    ...Object.entries({ points, lines, patches, bodies }).flatMap(([key, list]) => listText(key, list)),
    `  "background": ${backgroundText(background)}`,
    ...Object.entries({ groups, parameters, expressions }).flatMap(([key, list]) => listText(key, list)),
    ...(problem === undefined ? [] : [`  "problem": ${problemText(problem)}`]),
  ];
  return `{\n${[...head, ...body].join(",\n")}\n}\n`;
}

const entities = v.array(v.unknown());
const writableProject = v.object({
  points: entities,
  lines: entities,
  patches: entities,
  bodies: v.optional(entities),
  groups: v.optional(entities),
  parameters: v.optional(entities),
  expressions: v.optional(entities),
  problem: v.optional(v.looseObject({ conditions: entities })),
  background: v.object({ nodes: entities, tetrahedra: entities, sources: v.optional(entities) }),
});

function backgroundText({ nodes, tetrahedra, sources, coverageMargin }: ProjectBackground): string {
  const parts = [`"nodes": ${rows(nodes, "    ")}`, `"tetrahedra": ${rows(tetrahedra, "    ")}`];
  if (sources !== undefined) parts.push(`"sources": ${rows(sources, "    ")}`);
  if (coverageMargin !== undefined) parts.push(`"coverageMargin": ${JSON.stringify(coverageMargin)}`);
  return `{\n${parts.map((part) => `    ${part}`).join(",\n")}\n  }`;
}

function problemText({ conditions, ...rest }: ProjectProblem): string {
  const parts = Object.entries(rest)
    .filter(([, value]) => value !== undefined)
    .map(([key, value]) => `"${key}": ${JSON.stringify(value)}`);
  return `{\n    ${[...parts, `"conditions": ${rows(conditions, "    ")}`].join(",\n    ")}\n  }`;
}

/** Writes one entity per line. As an element of a list, a value that JSON cannot store becomes null. */
function rows(list: readonly unknown[], indent: string): string {
  if (list.length === 0) return "[]";
  return `[\n${list.map((entity) => `${indent}  ${JSON.stringify([entity]).slice(1, -1)}`).join(",\n")}\n${indent}]`;
}

/** Checks format and version first: in a file of another version, all other errors would be misleading. */
function checkHead(value: unknown): ReadError | undefined {
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    return notAProject("it holds no JSON object");
  }
  const { format, version } = value as { format?: unknown; version?: unknown };
  if (format !== PROJECT_FORMAT) return notAProject(`"format" is not "${PROJECT_FORMAT}"`);
  if (typeof version === "number" && version > PROJECT_VERSION) {
    return {
      code: "later-version",
      message: `the file has version ${version}; this program reads versions up to ${PROJECT_VERSION}`,
      remedy: "Update Tetrafront.",
      path: "version",
    };
  }
  if (typeof version === "number" && version < PROJECT_VERSION && Number.isInteger(version) && version >= 1) {
    return {
      code: "invalid-project",
      message: `expected a project of version ${PROJECT_VERSION}, found version ${version}`,
      remedy: "Pass it through `parseProject()` or `readProject()`, which upgrade it.",
      path: "version",
    };
  }
  return undefined;
}

function notAProject(why: string): ReadError {
  return {
    code: "not-a-project",
    message: `this is not a Tetrafront project: ${why}`,
    remedy: `Use a file that begins with { "format": "${PROJECT_FORMAT}", "version": ${PROJECT_VERSION}, … }.`,
  };
}

function describeSyntaxError(text: string, failure: unknown): ReadError {
  const reason = failure instanceof Error ? failure.message : String(failure);
  const position = /position (\d+)/.exec(reason)?.[1];
  const offset = position === undefined ? undefined : Number(position);
  if (/unexpected end|unterminated|end of data/i.test(reason)) {
    const line = text.split("\n").length;
    const { error } = truncatedAt({ line }, "in the middle of its JSON");
    return error;
  }
  return {
    code: "malformed-file",
    message: `this is not JSON: ${reason.replace(/ in JSON at position.*| \(line \d+ column \d+\)/, "")}`,
    remedy: "Correct the text there, or save the project again from the program that wrote it.",
    line: offset === undefined ? undefined : text.slice(0, offset).split("\n").length,
  };
}

function invalidProject({ path, message }: SchemaProblem): ReadError {
  return {
    code: "invalid-project",
    message: path === "" ? message : `${path}: ${message}`,
    remedy: "Correct the value there; project.schema.json in the package describes every field.",
    path,
  };
}
