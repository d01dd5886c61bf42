import type { Project, ProjectExpression } from "tetrafront";
import { parameterValues } from "../expressions/parameters";
import { isPlainNumber, readNumber } from "../expressions/expression";
import type { ProjectDraft } from "./draft-records";
import type { DocumentContent, DraftChange, DraftEdit } from "./edit";
import {
  isAllowed,
  numberAt,
  pathKey,
  recordFinder,
  samePath,
  setNumberAt,
  type NumberPath,
} from "./number-paths";

/** Expressions that the project keeps for its numbers. */

/** Returns the expression of a number; undefined if it has none. */
export const expressionOf = ({ expressions }: Project, path: NumberPath): string | undefined =>
  expressions?.find((kept) => samePath(kept, path))?.expression;

/** Returns a typed text if it is worth keeping: anything but a plain number. */
export const expressionFrom = (text: string): string | null => (isPlainNumber(text) ? null : text.trim());

/** Adds to an edit of a number that the project keeps its expression, or forgets it if null. */
export function keepingExpression(edit: DraftEdit, path: NumberPath, expression: string | null): DraftEdit {
  return keepingExpressions(edit, [{ path, expression }]);
}

/** As `keepingExpression`, for several numbers. */
export function keepingExpressions(
  edit: DraftEdit,
  kept: readonly { readonly path: NumberPath; readonly expression: string | null }[],
): DraftEdit {
  return {
    ...edit,
    change: (draft) => {
      edit.change(draft);
      for (const { path, expression } of kept) keep(draft.project, path, expression);
    },
  };
}

/** Keeps the expressions of the coordinates of a new point; null for a coordinate without one. */
export function keepCoordinates(
  project: ProjectDraft,
  point: number,
  expressions: readonly (string | null)[] = [],
): void {
  expressions.forEach((expression, axis) => {
    if (expression !== null)
      keep(project, { kind: "point", id: point, field: `position.${axis}` }, expression);
  });
}

function keep(project: ProjectDraft, path: NumberPath, expression: string | null): void {
  const index = project.expressions?.findIndex((kept) => samePath(kept, path)) ?? -1;
  if (expression === null) {
    if (index < 0) return;
    if (project.expressions?.length === 1) delete project.expressions;
    else project.expressions?.splice(index, 1);
    return;
  }
  const { kind, id, field } = path;
  const found = project.expressions?.[index];
  if (found) found.expression = expression;
  else (project.expressions ??= []).push({ kind, id, field, expression });
}

/**
 * Returns a change that makes numbers and their expressions agree after a step. A number follows its expression if the
 * expression or a parameter has changed. An expression is forgotten if its number was changed in another way, or if its
 * parameter is gone. Undefined if nothing is to be done. O(expressions + entities of their kinds).
 */
export function agreement(before: Project, after: Project): DraftChange<DocumentContent> | undefined {
  const { expressions = [] } = after;
  if (expressions.length === 0) return undefined;
  const [oldValues, values] = [parameterValues(before.parameters), parameterValues(after.parameters)];
  const oldTexts = new Map((before.expressions ?? []).map((kept) => [pathKey(kept), kept.expression]));
  const [oldRecord, record] = [recordFinder(before), recordFinder(after)];
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
      const draftOf = draftFinder(after, project);
      for (const [kept, value] of set) setNumberAt(draftOf(kept), kept.field, value);
      if (forgotten.size === 0) return;
      const rest = expressions.filter((kept) => !forgotten.has(pathKey(kept)));
      if (rest.length > 0) project.expressions = rest;
      else delete project.expressions;
    },
  };
}

function valueOf(path: NumberPath, text: string, values: ReadonlyMap<string, number>): number | null {
  const value = readNumber(text, values);
  return value !== null && isAllowed(path, value) ? value : null;
}

/** Returns a function that makes the draft of a record, and of no other record. */
function draftFinder(project: Project, draft: ProjectDraft): (path: NumberPath) => object | undefined {
  const lists = {
    point: [project.points, draft.points],
    body: [project.bodies ?? [], draft.bodies ?? []],
    "background-node": [project.background.nodes, draft.background.nodes],
    source: [project.background.sources ?? [], draft.background.sources ?? []],
  } as const;
  return ({ kind, id }) => {
    const [records, drafts] = lists[kind];
    return drafts[records.findIndex((record) => record.id === id)];
  };
}
