import { SOURCE_GROWTH, type BodySurface, type LineType, type PatchType, type Project } from "tetrafront";
import { stepNames } from "../strings";
import { draftFinder } from "./draft-records";
import type { DraftEdit } from "./edit";
import { changeLineTypes, changePatchTypes } from "./edits";
import { bodiesOf, recordsOf, type Entity } from "./entities";
import { expressionFinder, keepingExpressions } from "./expression-edits";
import { numberAt, recordFinder, setNumberAt, type EntityNumber } from "./number-paths";

/** What several selected entities have in common, and edits that change it in all of them. */

/** Numbers that entities of several kinds have. */
export type CommonField =
  | `position.${0 | 1 | 2}`
  | "size"
  | "stretching"
  | "distance"
  | "growth"
  | "placement.scale"
  | "remeshing.size"
  | "remeshing.tolerance";

const coordinates = ["position.0", "position.1", "position.2"] as const;

/** The numbers of each kind that a selection can change together. */
const fieldsOf: { readonly [K in Entity["kind"]]?: readonly CommonField[] } = {
  point: coordinates,
  "background-node": [...coordinates, "size", "stretching"],
  source: ["size", "distance", "growth"],
  body: ["placement.scale", "remeshing.size", "remeshing.tolerance"],
};

/** Values of numbers that a file may omit. */
const defaults: { readonly [F in CommonField]?: number } = {
  stretching: 1,
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

/** Sets a number of all given entities, with the expression that was typed. Costs as much as `commonNumbers`. */
export function setCommonNumber(
  entities: readonly Entity[],
  field: CommonField,
  value: number,
  expression: string | null,
): DraftEdit {
  const edit: DraftEdit = {
    label: stepNames.setCommon[field](entities.length),
    mergeKey: `common-${field}-${entities.map(({ kind, id }) => `${kind}${id}`).join()}`,
    change: ({ project }) => {
      const find = draftFinder(project);
      for (const entity of entities) {
        const record = find(entity);
        setNumberAt(record, field, value);
        if (field === "stretching" && record && "stretching" in record && !("direction" in record)) {
          Object.assign(record, { direction: [1, 0, 0] });
        }
      }
    },
  };
  const paths = entities.flatMap((entity) => pathOf(entity, field) ?? []);
  return keepingExpressions(
    edit,
    paths.map((path) => ({ path, expression })),
  );
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
