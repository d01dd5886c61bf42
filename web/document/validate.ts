import type { Diagnostic, EntityRef, SurfaceInspection } from "tetrafront";
import type { Project, ProjectBody } from "tetrafront/project";
import {
  bodyLabel,
  drawnKinds,
  entityKey,
  patchAt,
  patchEntity,
  recordsOf,
  type DrawnKind,
  type Entity,
} from "./entities";
import { remedyInApp, strings } from "../strings";
import { placed } from "./placement";
import type { Position } from "./position";

/** A problem of the project or its mesh, with the entities to select. */
export interface Problem {
  /** Stable while the problem stays the same. */
  readonly key: string;
  readonly severity: "warning" | "error";
  readonly code: string;
  readonly message: string;
  readonly remedy: string;
  readonly entities: readonly Entity[];
  /** Indices of triangles in the surface that the last run rejected, or in the given surface of `body`. */
  readonly triangles: readonly number[];
  /** Id of the body that the triangles belong to. */
  readonly body: number | null;
  readonly position: Position | null;
}

function isDrawn(kind: string): kind is DrawnKind {
  return (drawnKinds as readonly string[]).includes(kind);
}

/** Returns the entities to select for the subject of a diagnostic: for a background tetrahedron, its nodes. */
function toEntities(project: Project, { kind, index, id }: EntityRef): Entity[] {
  if (kind === "background-tetrahedron") {
    const nodes = project.background.tetrahedra[index] ?? [];
    return nodes.map((node) => ({ kind: "background-node", id: node }));
  }
  if (kind === "patch") {
    const patch = id === undefined ? patchAt(project, index) : patchEntity(project, id);
    return patch ? [patch] : [];
  }
  if (!isDrawn(kind)) return [];
  const found = id ?? recordsOf(project, kind)[index]?.id;
  return found === undefined ? [] : [{ kind, id: found }];
}

/**
 * Returns the errors and warnings among diagnostics, without repetition: errors first, otherwise in order. Information is
 * left out: it is in the log and needs no action.
 */
export function toProblems(project: Project, diagnostics: readonly Diagnostic[]): Problem[] {
  const problems = new Map<string, Problem>();
  for (const diagnostic of diagnostics) {
    const { code, severity, message, entities, position, body = null } = diagnostic;
    const key = `${code}: ${message}`;
    if (severity === "information" || problems.has(key)) continue;
    problems.set(key, {
      key,
      severity,
      code,
      message,
      remedy: remedyInApp(diagnostic),
      entities: entities.flatMap((ref) => toEntities(project, ref)),
      triangles: trianglesOf(entities),
      body,
      position: position ?? null,
    });
  }
  return sorted([...problems.values()]);
}

const trianglesOf = (entities: readonly EntityRef[]): number[] =>
  entities.flatMap(({ kind, index }) => (kind === "triangle" ? [index] : []));

const rank = { error: 0, warning: 1 };

/** Returns problems with the errors first. */
export const sorted = (problems: readonly Problem[]): Problem[] =>
  problems.toSorted((a, b) => rank[a.severity] - rank[b.severity]);

/** Warnings about the shape of given triangles, which remeshing replaces. */
const shapeCodes: ReadonlySet<string> = new Set(["needle-surface", "coarse-surface"]);

/** Returns the problems of a body's given surface, at their positions in the model. */
export function bodyProblems(
  { id, placement, surface = "remesh" }: ProjectBody,
  { diagnostics }: SurfaceInspection,
): Problem[] {
  const isRemeshed = surface === "remesh";
  return diagnostics.flatMap((diagnostic, index) => {
    const { code, severity, message, entities, position } = diagnostic;
    return severity === "information" || (isRemeshed && shapeCodes.has(code))
      ? []
      : [
          {
            key: `body ${id} ${index} ${code}: ${message}`,
            severity,
            code,
            message,
            remedy: remedyInApp(diagnostic, true),
            entities: [{ kind: "body", id } as const],
            triangles: trianglesOf(entities),
            body: id,
            position: position ? placed(position, placement) : null,
          },
        ];
  });
}

/** Code of the problem that bodies touch, which a run solves. */
export const touchingCode = "touching-bodies";

/** Warns that bodies touch, and says what “Generate mesh” will do. */
export function touchingProblem(bodies: readonly ProjectBody[]): Problem {
  const { message, remedy } = strings.bodies.touching;
  const text = message(bodies.map(bodyLabel));
  return {
    key: `${touchingCode}: ${text}`,
    severity: "warning",
    code: touchingCode,
    message: text,
    remedy,
    entities: bodies.map(({ id }) => ({ kind: "body", id })),
    triangles: [],
    body: null,
    position: null,
  };
}

/** What a run has found while it joined bodies. */
interface OverlapNote {
  readonly text: string;
  readonly remedy?: string;
}

const overlapCode = { severity: "warning", code: "touching-solids" } as const;

/** Warns of what a run has found while it joined bodies. */
export function overlapProblem({ text, remedy = "" }: OverlapNote): Problem {
  const nothing = { entities: [], triangles: [], body: null, position: null };
  return { key: `${overlapCode.code}: ${text}`, ...overlapCode, message: text, remedy, ...nothing };
}

/** Returns the same warning as the reports of files have it. */
export function overlapDiagnostic({ text, remedy = "" }: OverlapNote): Diagnostic {
  return { ...overlapCode, message: text, remedy, entities: [], data: {} };
}

/** Entities and triangles to emphasize in the view. */
export interface Defects {
  /** Indices of triangles in the surface that the last run rejected. */
  readonly triangles: readonly number[];
  /** Ids of patches that are invalid as a whole. */
  readonly patches: ReadonlySet<number>;
  /** Ids of lines at which the surface is open. */
  readonly openLines: ReadonlySet<number>;
  /** The model is still being drawn: its mesh has not been asked for. */
  readonly areOpenLinesExpected: boolean;
  /** Indices of triangles in the given surfaces of bodies, by body. */
  readonly bodies: ReadonlyMap<number, readonly number[]>;
}

/** Largest number of triangles of a body that are highlighted. */
const maxBodyTriangles = 20_000;

/**
 * Returns the defects that errors name: their triangles if there are any, else their patches. `isMeshed`: a mesh of the
 * model was asked for.
 */
export function defectsOf(problems: readonly Problem[], isMeshed = true): Defects {
  const errors = problems.filter(({ severity }) => severity === "error");
  const aboutPatches = errors.filter(
    ({ triangles, entities }) => triangles.length === 0 && entities[0]?.kind === "patch",
  );
  const bodies = new Map<number, number[]>();
  for (const { body, triangles } of errors) {
    if (body === null || triangles.length === 0) continue;
    const known = bodies.get(body) ?? [];
    if (known.length < maxBodyTriangles) bodies.set(body, [...known, ...triangles]);
  }
  const patches = aboutPatches.flatMap(({ entities }) => entities.filter(({ kind }) => kind === "patch"));
  return {
    triangles: errors.flatMap(({ triangles, body }) => (body === null ? triangles : [])),
    patches: new Set(patches.map(({ id }) => id)),
    openLines: new Set(
      errors
        .filter(({ code }) => code === "open-edge")
        .flatMap(({ entities }) => entities.flatMap(({ kind, id }) => (kind === "line" ? [id] : []))),
    ),
    areOpenLinesExpected: !isMeshed,
    bodies,
  };
}

/** Returns the problems of each entity, by entity key. */
export function problemsByEntity(problems: readonly Problem[]): ReadonlyMap<string, readonly Problem[]> {
  const byEntity = new Map<string, Problem[]>();
  for (const problem of problems) {
    for (const entity of problem.entities) {
      const key = entityKey(entity);
      const known = byEntity.get(key);
      if (known) known.push(problem);
      else byEntity.set(key, [problem]);
    }
  }
  return byEntity;
}

export interface ProblemGroup {
  readonly code: string;
  readonly severity: Problem["severity"];
  readonly problems: readonly Problem[];
}

/** Groups problems by severity and code, in the order of their first occurrence. */
export function groupProblems(problems: readonly Problem[]): readonly ProblemGroup[] {
  const groups = new Map<string, Problem[]>();
  for (const problem of problems) {
    const key = `${problem.severity} ${problem.code}`;
    groups.set(key, [...(groups.get(key) ?? []), problem]);
  }
  return [...groups.values()].flatMap((members) => {
    const [first] = members;
    return first ? [{ code: first.code, severity: first.severity, problems: members }] : [];
  });
}
