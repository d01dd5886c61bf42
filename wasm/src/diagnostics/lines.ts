/** Lists of diagnostics as lines: a few per code, with a count of the others. */
import type { DiagnosticCode } from "./codes.js";
import type { Diagnostic } from "./diagnostic.js";

/** Largest number of lines per code, unless the user asks for more: more of the same would hide the others. */
const MAX_PER_CODE = 5;

export interface DiagnosticLine {
  readonly severity: Diagnostic["severity"];
  /** Message and remedy. */
  readonly text: string;
}

/**
 * Returns a few lines per code, in the order in which the codes first appear, and one with the number of all others of the
 * code. A remedy is stated once per code.
 */
export function diagnosticLines(
  diagnostics: readonly Diagnostic[],
  perCode = MAX_PER_CODE,
): DiagnosticLine[] {
  return [...byKind(diagnostics)].flatMap((group) => linesOf(group, perCode));
}

/** Groups diagnostics by severity and code, in the order of first appearance. */
function byKind(diagnostics: readonly Diagnostic[]): Iterable<readonly Diagnostic[]> {
  const groups = new Map<string, Diagnostic[]>();
  for (const diagnostic of diagnostics) {
    const key = `${diagnostic.severity} ${diagnostic.code}`;
    const group = groups.get(key);
    if (group === undefined) groups.set(key, [diagnostic]);
    else group.push(diagnostic);
  }
  return groups.values();
}

/** Returns the number of problems of this severity, including those that are not listed individually. */
export function countOf(diagnostics: readonly Diagnostic[], severity: Diagnostic["severity"]): number {
  const found = diagnostics.filter((diagnostic) => diagnostic.severity === severity);
  return [...byKind(found)].reduce((sum, group) => sum + allOfAKind(group), 0);
}

/** Codes whose only diagnostic is about all elements at once; its message states their number. */
const SUMMARIES: ReadonlySet<DiagnosticCode> = new Set(["near-nodes", "needle-surface", "poor-elements"]);

/**
 * Returns the total number of problems of one kind, of which only some are listed. Each diagnostic of a given
 * surface states the total. A diagnostic of a drawing counts only the problems at its own lines and patches.
 */
function allOfAKind(group: readonly Diagnostic[]): number {
  const [first] = group;
  if (first === undefined || SUMMARIES.has(first.code)) return group.length;
  if (!isOfSurface(first) || !("count" in first.data)) return group.length;
  return Math.max(group.length, first.data.count ?? 0);
}

/** Returns whether the diagnostic is about a given surface, whose triangles and nodes have no names. */
function isOfSurface({ entities }: Diagnostic): boolean {
  return entities.every(({ kind }) => kind === "triangle" || kind === "surface-node");
}

/**
 * Diagnostics that name no entity or position and differ only in their numbers become one line with a count.
 */
function linesOf(group: readonly Diagnostic[], perCode: number): DiagnosticLine[] {
  const [first] = group;
  if (first === undefined) return [];
  const { severity, code } = first;
  const kinds = new Map<string, { readonly message: string; readonly remedy: string; count: number }>();
  for (const diagnostic of group) {
    const { message, remedy, position } = diagnostic;
    // Coordinates that are not finite are not a position either.
    const isAlike = isOfSurface(diagnostic) && (position === undefined || code === "not-finite");
    const key = isAlike ? message.replace(/[-+\d.e]*\d/g, "#") : `${message} ${remedy}`;
    const known = kinds.get(key);
    if (known === undefined) kinds.set(key, { message, remedy, count: 1 });
    else known.count++;
  }
  const told = new Set([""]);
  const shown = [...kinds.values()].slice(0, perCode);
  const rest = allOfAKind(group) - shown.reduce((sum, { count }) => sum + count, 0);
  const lines = shown.map(({ message, remedy, count }) => {
    const text = told.has(remedy) ? `${message}.` : `${message}. ${remedy}`;
    told.add(remedy);
    return { severity, text: count === 1 ? text : `${text} (and ${count - 1} similar)` };
  });
  return rest > 0 ? [...lines, { severity, text: `and ${rest} more "${code}".` }] : lines;
}
