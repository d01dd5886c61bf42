import { current, isDraft } from "mutative";
import type { Project, ProjectExpression } from "tetrafront/project";
import { isPlainNumber, readNumber } from "../expressions/expression";
import { draftFinder, recordOf, type ProjectDraft } from "./draft-records";
import type { DraftChange, DraftEdit } from "./edit";
import { projectNumbers } from "./length-units";
import { holderFinder, isAllowed, numberAt, pathKey, setNumberAt, type NumberPath } from "./number-paths";

/** Expressions that the project keeps for its numbers. */

/** Returns the expression of a number; undefined if it has none. */
export function expressionOf({ expressions }: Project, path: NumberPath): string | undefined {
  const key = pathKey(path);
  return expressions?.find((kept) => pathKey(kept) === key)?.expression;
}

/** Returns a function that finds the expressions of numbers; it indexes them once. */
export function expressionFinder({ expressions = [] }: Project): (path: NumberPath) => string | undefined {
  const texts = new Map(expressions.map((kept) => [pathKey(kept), kept.expression]));
  return (path) => texts.get(pathKey(path));
}

/** What an expression is kept for; null to forget it. */
export interface KeptExpression {
  readonly path: NumberPath;
  readonly expression: string | null;
}

/** Returns a typed text if it is worth keeping: anything but a plain number. */
export const expressionFrom = (text: string): string | null => (isPlainNumber(text) ? null : text.trim());

/** Adds to an edit of a number that the project keeps its expression, or forgets it if null. */
export function keepingExpression(edit: DraftEdit, path: NumberPath, expression: string | null): DraftEdit {
  return keepingExpressions(edit, [{ path, expression }]);
}

/** As `keepingExpression`, for several numbers. O(numbers + expressions of the project). */
export function keepingExpressions(edit: DraftEdit, kept: readonly KeptExpression[]): DraftEdit {
  return {
    ...edit,
    change: (draft) => {
      edit.change(draft);
      keep(draft.project, kept);
    },
  };
}

/** A new point with the expressions of its coordinates; null for a coordinate without one. */
export interface TypedPoint {
  readonly id: number;
  readonly expressions?: readonly (string | null)[] | undefined;
}

/** Keeps the expressions of the coordinates of new points. O(points + expressions of the project). */
export function keepCoordinates(
  project: Pick<ProjectDraft, "expressions">,
  points: readonly TypedPoint[],
): void {
  const kept = points.flatMap(({ id, expressions = [] }) =>
    expressions.map((expression, axis): KeptExpression => ({
      path: { kind: "point", id, field: `position.${axis}` },
      expression,
    })),
  );
  keep(
    project,
    kept.filter(({ expression }) => expression !== null),
  );
}

/** Returns the expressions of the coordinates of a point; null for a coordinate without one. */
export const coordinatesOf = (project: Project, id: number): readonly (string | null)[] =>
  [0, 1, 2].map((axis) => expressionOf(project, { kind: "point", id, field: `position.${axis}` }) ?? null);

function keep(project: Pick<ProjectDraft, "expressions">, kept: readonly KeptExpression[]): void {
  if (kept.length === 0) return;
  const { expressions = [] } = project;
  // A search in the draft would make a draft of every expression.
  const before = isDraft(expressions) ? current(expressions) : expressions;
  const after = withKept(before, kept);
  if (after === before) return;
  if (after.length > 0) project.expressions = [...after];
  else delete project.expressions;
}

/** Returns a list of expressions with those to keep, and without those to forget; the same list if nothing changes. */
export function withKept(
  before: readonly ProjectExpression[],
  kept: readonly KeptExpression[],
): readonly ProjectExpression[] {
  if (kept.length === 0) return before;
  const texts = new Map(before.map((one) => [pathKey(one), one]));
  let isChanged = false;
  for (const { path, expression } of kept) {
    const key = pathKey(path);
    if (texts.get(key)?.expression === (expression ?? undefined)) continue;
    if (expression === null) texts.delete(key);
    else texts.set(key, { ...path, expression });
    isChanged = true;
  }
  return isChanged ? [...texts.values()] : before;
}

/**
 * Returns a change that makes numbers and their expressions agree after a step. A number follows its expression if the
 * expression or a parameter has changed. An expression is forgotten if its number was changed in another way, or if its
 * parameter is gone. Undefined if nothing is to be done. O(expressions + entities of their kinds).
 */
export function agreement(before: Project, after: Project): DraftChange | undefined {
  const { expressions = [] } = after;
  if (expressions.length === 0) return undefined;
  const [oldValues, values] = [projectNumbers(before), projectNumbers(after)];
  const oldTexts = new Map((before.expressions ?? []).map((kept) => [pathKey(kept), kept.expression]));
  const [oldRecord, record] = [holderFinder(before), holderFinder(after)];
  const set: (readonly [ProjectExpression, number])[] = [];
  const forgotten = new Set<string>();
  for (const kept of expressions) {
    const value = valueOf(kept, kept.expression, values);
    const oldText = oldTexts.get(pathKey(kept));
    const oldValue = oldText === undefined ? null : valueOf(kept, oldText, oldValues);
    const now = numberAt(record(kept), kept.field);
    if (value === now) continue;
    if (value === null) {
      if (oldValue !== null) forgotten.add(pathKey(kept));
    } else if (oldText !== kept.expression || value !== oldValue) set.push([kept, value]);
    else if (now !== numberAt(oldRecord(kept), kept.field)) forgotten.add(pathKey(kept));
  }
  if (set.length === 0 && forgotten.size === 0) return undefined;
  return {
    change: ({ project }) => {
      const draftOf = draftFinder(project);
      for (const [kept, value] of set) {
        setNumberAt(kept.kind === "meshing" ? project.meshing : draftOf(kept), kept.field, value);
        if (kept.kind === "body" && kept.field.startsWith("features.")) outdate(project, kept);
      }
      if (forgotten.size === 0) return;
      const rest = expressions.filter((kept) => !forgotten.has(pathKey(kept)));
      if (rest.length > 0) project.expressions = rest;
      else delete project.expressions;
    },
  };
}

/** Notes that the triangles of a solid are those of other features. */
function outdate({ bodies = [] }: ProjectDraft, { id }: { readonly id: number }): void {
  const body = recordOf(bodies, id);
  if (body) body.isOutdated = true;
}

function valueOf(path: NumberPath, text: string, values: ReadonlyMap<string, number>): number | null {
  const value = readNumber(text, values);
  return value !== null && isAllowed(path, value) ? value : null;
}
