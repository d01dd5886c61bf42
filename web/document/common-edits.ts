import { SOURCE_GROWTH } from "tetrafront/internal";
import type { LineType, PatchType, BodySurface, Project } from "tetrafront/project";
import { namesIn, readNumber, withNameReplaced } from "../expressions/expression";
import { formulaText, operandText, plus, quantity, valueOf, type Quantity } from "../expressions/quantity";
import { stepNames } from "../strings";
import { draftFinder, type ProjectDraft } from "./draft-records";
import type { DraftEdit } from "./edit";
import { changeLineTypes, changePatchTypes } from "./edits";
import { bodiesOf, recordsOf, type Entity } from "./entities";
import { expressionFinder, keepingExpressions } from "./expression-edits";
import { projectNumbers } from "./length-units";
import { numberAt, recordFinder, setNumberAt, type EntityNumber } from "./number-paths";
import { addDirection, addSecondDirection } from "./node-directions";
import { isTooLong } from "./quantity-positions";

/** What several selected entities have in common, and edits that change it in all of them. */

/** Numbers that entities of several kinds have. */
export type CommonField =
  | `position.${0 | 1 | 2}`
  | "size"
  | "stretching"
  | "secondStretching"
  | "distance"
  | "growth"
  | "placement.scale"
  | "remeshing.size"
  | "remeshing.tolerance";

const coordinates = ["position.0", "position.1", "position.2"] as const;

/** The numbers of each kind that a selection can change together. */
const fieldsOf: { readonly [K in Entity["kind"]]?: readonly CommonField[] } = {
  point: coordinates,
  "background-node": [...coordinates, "size", "stretching", "secondStretching"],
  source: ["size", "distance", "growth"],
  body: ["placement.scale", "remeshing.size", "remeshing.tolerance"],
};

/** Values of numbers that a file may omit. */
const defaults: { readonly [F in CommonField]?: number } = {
  stretching: 1,
  secondStretching: 1,
  distance: 0,
  growth: SOURCE_GROWTH,
};

const pathOf = ({ kind, id }: Entity, field: CommonField): EntityNumber | undefined =>
  kind === "line" || kind === "patch" || kind === "body-patch" ? undefined : { kind, id, field };

/** A number that all selected entities have. */
export interface CommonNumber {
  readonly field: CommonField;
  /** Null if the entities differ, or none has the number. */
  readonly value: number | null;
  /** None has the number: the program chooses it. */
  readonly isAutomatic: boolean;
  /** The smallest of the values; null if not all entities have the number. */
  readonly smallest: number | null;
  readonly expression: string | undefined;
}

/** Returns the numbers that all given entities have. O(entities + records of their kinds + expressions). */
export function commonNumbers(project: Project, entities: readonly Entity[]): CommonNumber[] {
  const [first] = entities;
  const fields = (first && fieldsOf[first.kind]) ?? [];
  const [record, expression] = [recordFinder(project), expressionFinder(project)];
  return fields
    .filter((field) => entities.every(({ kind }) => fieldsOf[kind]?.includes(field)))
    .map((field) => ({
      field,
      values: entities.map((one) => numberAt(record(one), field) ?? defaults[field]),
    }))
    .map(({ field, values }) => ({
      field,
      value: same(values),
      isAutomatic: values.every((value) => value === undefined),
      smallest: values.reduce<number | null>(
        (least, value) => (least === null || value === undefined ? null : Math.min(least, value)),
        Infinity,
      ),
      expression:
        same(
          entities.map((entity) => {
            const path = pathOf(entity, field);
            return path && expression(path);
          }),
        ) ?? undefined,
    }));
}

/** Returns the value that all have; null if they differ. */
function same<Value>(values: readonly (Value | undefined)[]): Value | null {
  const [first] = values;
  return first !== undefined && values.every((value) => value === first) ? first : null;
}

/** What a number of one entity becomes. */
export interface OwnChange {
  readonly entity: Entity;
  readonly value: number;
  readonly expression: string | null;
}

/** Sets a number of all given entities, with the expression that was typed. Costs as much as `commonNumbers`. */
export const setCommonNumber = (
  entities: readonly Entity[],
  field: CommonField,
  value: number,
  expression: string | null,
): DraftEdit =>
  setNumbers(
    field,
    entities.map((entity) => ({ entity, value, expression })),
  );

/** Sets a number of each entity to a value of its own. Costs as much as `commonNumbers`. */
export function setNumbers(field: CommonField, changes: readonly OwnChange[]): DraftEdit {
  const edit: DraftEdit = {
    label: stepNames.setCommon[field](changes.length),
    mergeKey: `common-${field}-${changes.map(({ entity: { kind, id } }) => `${kind}${id}`).join()}`,
    change: ({ project }) => {
      const find = draftFinder(project);
      for (const { entity, value } of changes) {
        const record = find(entity);
        setNumberAt(record, field, value);
        if (entity.kind !== "background-node" || !record) continue;
        const node = record as ProjectDraft["background"]["nodes"][number];
        if (field === "stretching") addDirection(node);
        if (field === "secondStretching") addSecondDirection(node);
      }
    },
  };
  const kept = changes.flatMap(({ entity, expression }) => {
    const path = pathOf(entity, field);
    return path ? [{ path, expression }] : [];
  });
  return keepingExpressions(edit, kept);
}

/** The names by which an expression refers to the numbers that an entity has itself. */
export const ownNames: { readonly [F in CommonField]: string } = {
  "position.0": "x",
  "position.1": "y",
  "position.2": "z",
  size: "size",
  stretching: "stretching",
  secondStretching: "secondStretching",
  distance: "distance",
  growth: "growth",
  "placement.scale": "scale",
  "remeshing.size": "size",
  "remeshing.tolerance": "tolerance",
};

const allOwnNames: ReadonlySet<string> = new Set(Object.values(ownNames));

/** Returns a function that finds a number of an entity, with its expression. */
function ownQuantities(project: Project): (entity: Entity, field: CommonField) => Quantity | undefined {
  const [record, textOf] = [recordFinder(project), expressionFinder(project)];
  return (entity, field) => {
    const value = numberAt(record(entity), field) ?? defaults[field];
    const path = pathOf(entity, field);
    return value === undefined ? undefined : quantity(value, path && textOf(path));
  };
}

/**
 * Returns what an expression in terms of each entity's own numbers, such as `z+0.1`, gives for the entities. A parameter
 * goes before an own number of the same name, also while it has no valid value. Parameters stay in the expressions of the
 * results. Null if one result is no number; undefined if the expression uses no own numbers. Costs as much as
 * `commonNumbers`.
 */
export function ownChanges(
  project: Project,
  entities: readonly Entity[],
  text: string,
): readonly OwnChange[] | null | undefined {
  const named = projectNumbers(project);
  const parameters = new Set(project.parameters?.map(({ name }) => name));
  const used = [...namesIn(text)].filter(
    (name) => allOwnNames.has(name) && !named.has(name) && !parameters.has(name),
  );
  if (used.length === 0) return undefined;
  const own = ownQuantities(project);
  const changes: OwnChange[] = [];
  for (const entity of entities) {
    const values = new Map(named);
    let expression = text.trim();
    for (const name of used) {
      const field = fieldsOf[entity.kind]?.find((one) => ownNames[one] === name);
      const number = field && own(entity, field);
      if (number === undefined) return null;
      values.set(name, valueOf(number));
      expression = withNameReplaced(expression, name, operandText(number));
    }
    const value = readNumber(text, values);
    if (value === null) return null;
    const isKept = namesIn(expression).size > 0 && !isTooLong(expression);
    changes.push({ entity, value, expression: isKept ? expression : null });
  }
  return changes;
}

/** Returns the changes that add a step to a number of each entity; null if one of them has no such number. */
export function steppedChanges(
  project: Project,
  entities: readonly Entity[],
  field: CommonField,
  step: number,
): readonly OwnChange[] | null {
  const own = ownQuantities(project);
  const changes: OwnChange[] = [];
  for (const entity of entities) {
    const before = own(entity, field);
    if (before === undefined) return null;
    const after = plus(before, step);
    // Ten steps of 0.1 are 1.
    const value = Number(valueOf(after).toPrecision(12));
    const expression = formulaText(after);
    changes.push({
      entity,
      value: expression === null ? value : valueOf(after),
      expression: isTooLong(expression) ? null : expression,
    });
  }
  return changes;
}

/** Returns the type that all given lines, or all given patches, have: null if they differ, undefined for other kinds. */
export function commonType(
  project: Project,
  entities: readonly Entity[],
  kind: "line" | "patch",
): LineType | PatchType | null | undefined {
  if (entities.length === 0 || entities.some((entity) => entity.kind !== kind)) return undefined;
  const types = new Map<number, LineType | PatchType>(
    recordsOf(project, kind).map(({ id, type }) => [id, type]),
  );
  return same(entities.map(({ id }) => types.get(id)));
}

/** Returns the treatment that all given bodies have: null if they differ, undefined for other kinds. */
export function commonSurface(project: Project, entities: readonly Entity[]): BodySurface | null | undefined {
  if (entities.length === 0 || entities.some(({ kind }) => kind !== "body")) return undefined;
  const surfaces = new Map(bodiesOf(project).map(({ id, surface = "remesh" }) => [id, surface]));
  return same(entities.map(({ id }) => surfaces.get(id)));
}

export const setCommonLineType = (entities: readonly Entity[], type: LineType): DraftEdit => ({
  label: stepNames.setCommonType(entities.length, "lines"),
  change: ({ project }) => changeLineTypes(project, idsOf(entities), type),
});

export const setCommonPatchType = (entities: readonly Entity[], type: PatchType): DraftEdit => ({
  label: stepNames.setCommonType(entities.length, "patches"),
  change: ({ project }) => changePatchTypes(project, idsOf(entities), type),
});

const idsOf = (entities: readonly Entity[]): readonly number[] => entities.map(({ id }) => id);
