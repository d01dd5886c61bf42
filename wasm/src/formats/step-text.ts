/**
 * Compares the text of a STEP file (ISO 10303-21) with what OpenCascade has read of it: it skips damaged entities, and
 * assumes a unit where none is given, without a word.
 */
import { plural } from "../base/plural.js";
import { PAUSE, STEP, type Steps } from "../base/steps.js";
import { listed } from "./groups.js";
import { failureAt, type ReadFailure, truncatedAt } from "./read-result.js";
import { lineAt } from "./xml-tags.js";

/** Entities that are solids. */
const SOLID = /^(MANIFOLD_SOLID_BREP|BREP_WITH_VOIDS|FACETED_BREP|FACETED_BREP_AND_BREP_WITH_VOIDS)\b/;
/** A statement with its number and its definition, up to the first semicolon. */
export const INSTANCE = /#(\d+)\s*=\s*([^;]*);/g;
/** A length unit is a multiple of the metre, or of another unit. */
const SCALE =
  /\bSI_UNIT\s*\(\s*(\$|\.[A-Z]+\.)\s*,\s*\.METRE\.\s*\)|\b(CONVERSION_BASED|CONTEXT_DEPENDENT)_UNIT\b/;
const UNITS_OF_CONTEXT = /GLOBAL_UNIT_ASSIGNED_CONTEXT\s*\(\s*\(([^)]*)\)/;

/** What the text of a STEP file states. */
export interface StepText {
  /** Number of solids that it defines. */
  readonly solids: number;
  /** Numbers of contexts, such as "#21", whose lengths have no unit that is defined. */
  readonly withoutUnit: readonly string[];
  /** Whether the head names a schema. */
  readonly hasSchema: boolean;
  /** Whether it ends as it must. */
  readonly isComplete: boolean;
}

/** Reads what the text of a STEP file states. O(bytes). */
export function* stepText(bytes: Uint8Array): Steps<StepText> {
  const text = new TextDecoder("latin1").decode(bytes);
  const lengthUnits = new Set<string>();
  const contexts: { readonly id: string; readonly units: readonly string[] }[] = [];
  let [solids, instances] = [0, 0];
  for (const [, id = "", definition = ""] of text.matchAll(INSTANCE)) {
    if (++instances % STEP === 0) yield PAUSE;
    if (SOLID.test(definition)) solids++;
    else if (definition.includes("LENGTH_UNIT")) {
      if (SCALE.test(definition)) lengthUnits.add(`#${id}`);
    } else {
      const units = UNITS_OF_CONTEXT.exec(definition)?.[1];
      if (units !== undefined)
        contexts.push({ id: `#${id}`, units: units.split(",").map((one) => one.trim()) });
    }
  }
  const withoutUnit = contexts.filter(({ units }) => !units.some((unit) => lengthUnits.has(unit)));
  return {
    solids,
    withoutUnit: withoutUnit.map(({ id }) => id),
    hasSchema: /FILE_SCHEMA\s*\(\s*\(\s*'[^']+'/.test(text.slice(0, text.indexOf("DATA;"))),
    isComplete: isComplete(text),
  };
}

/** Returns what is wrong with the frame of a STEP file that cannot be read; undefined if it is complete. O(bytes). */
export function damagedStep(bytes: Uint8Array): ReadFailure | undefined {
  const text = new TextDecoder("latin1").decode(bytes);
  if (!/^[^A-Z]*ISO-10303-21\s*;/.test(text)) {
    const message = 'a STEP file must begin with "ISO-10303-21;"';
    return failureAt(
      { line: 1 },
      message,
      "Export the part as STEP; this file is damaged or of another format.",
    );
  }
  if (isComplete(text)) return undefined;
  return truncatedAt({ line: lineAt(bytes, bytes.length) }, "without END-ISO-10303-21");
}

const isComplete = (text: string): boolean => /END-ISO-10303-21\s*;\s*$/.test(text.slice(-END_LENGTH));

/** Number of bytes at the end among which the last statement is. */
const END_LENGTH = 1000;

/**
 * Returns what is damaged in a STEP file of which `read` closed solids were read: this many at most, because an assembly may
 * use a solid several times.
 */
export function stepNotes({ solids, withoutUnit, hasSchema, isComplete }: StepText, read: number): string[] {
  const known = read === 0 ? "none was" : `at most ${read} ${read === 1 ? "was" : "were"}`;
  const lost = `the file defines ${plural(solids, "solid")}, of which ${known} read completely; the others could not be read, or are not used`;
  const unit = `the file gives no valid unit of length for ${listed(withoutUnit)}; the scale of parts may be wrong`;
  return [
    ...(read < solids ? [lost] : []),
    ...(withoutUnit.length > 0 ? [unit] : []),
    ...(hasSchema ? [] : ["the head of the file is damaged: it names no schema"]),
    ...(isComplete ? [] : ["the file does not end with END-ISO-10303-21; parts may be missing"]),
  ];
}
