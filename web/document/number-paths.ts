import { LIMITS } from "tetrafront";
import type { Project, ProjectExpression } from "tetrafront/project";
import { indexById, recordsOf, type DrawnKind, type Entity } from "./entities";

type WithoutExpression<Expression> = Expression extends unknown ? Omit<Expression, "expression"> : never;

/** One number of an entity or of the mesh settings: the subject of an expression. */
export type NumberPath = WithoutExpression<ProjectExpression>;

/** One number of an entity. */
export type EntityNumber = Extract<NumberPath, { readonly id: number }>;

/** The uniform size. */
export const uniformSizePath = { kind: "meshing", field: "size" } as const satisfies NumberPath;

export const pathKey = (path: NumberPath): string =>
  `${path.kind}-${path.kind === "meshing" ? "" : path.id}-${path.field}`;

/** Indices by id, per list of records. */
const indicesOf = new WeakMap<object, ReadonlyMap<number, number>>();
/** The indices found last, by kind: they hold for most records of a list that an edit has made of another one. */
const lastIndices = new Map<DrawnKind, ReadonlyMap<number, number>>();

/** Returns a function that finds the records of a project by kind and id; it indexes a list once, if need be. */
export function recordFinder(project: Project): (entity: Entity) => object | undefined {
  return ({ kind, id }) => {
    const records = recordsOf(project, kind);
    const guess = records[lastIndices.get(kind)?.get(id) ?? -1];
    if (guess?.id === id) return guess;
    const indices = indicesOf.get(records) ?? indexById(project, kind);
    indicesOf.set(records, indices);
    lastIndices.set(kind, indices);
    return records[indices.get(id) ?? -1];
  };
}

/** Returns a function that finds what has the numbers of expressions; it indexes each kind once. */
export function holderFinder(project: Project): (path: NumberPath) => object | undefined {
  const find = recordFinder(project);
  return (path) => (path.kind === "meshing" ? project.meshing : find(path));
}

/** Returns what a record has at a key, or the record of a list with an id. */
function valueIn(holder: unknown, key: string): unknown {
  if (typeof holder !== "object" || holder === null) return undefined;
  const hasIds = Array.isArray(holder) && typeof holder[0] === "object" && "id" in holder[0];
  if (hasIds) return (holder as readonly { readonly id: number }[]).find(({ id }) => id === Number(key));
  return (holder as Readonly<Record<string, unknown>>)[key];
}

/** Returns the number at a path of fields in a record, such as `position.0`; undefined if there is none. */
export function numberAt(record: object | undefined, field: string): number | undefined {
  if (!record) return undefined;
  let at: unknown = record;
  for (const key of field.split(".")) at = valueIn(at, key);
  return typeof at === "number" ? at : valuesIfMissing[field];
}

/** Values of numbers that a record may omit, if they are known. */
const valuesIfMissing: Readonly<Record<string, number>> = {
  "placement.scale": 1,
  "placement.position.0": 0,
  "placement.position.1": 0,
  "placement.position.2": 0,
};

/** Returns what holds the number at a path, if a record may omit it. */
function newHolder(path: string): object | undefined {
  if (path === "placement.position") return [0, 0, 0];
  return path === "placement" || path === "remeshing" ? {} : undefined;
}

/**
 * Sets the number at a path of fields in a draft of a record. Adds the placement or the remeshing of a body if it has none;
 * does nothing if something else that should hold the number is missing.
 */
export function setNumberAt(record: object | undefined, field: string, value: number): void {
  const keys = field.split(".");
  const last = keys.pop() ?? "";
  let at: unknown = record;
  keys.forEach((key, depth) => {
    if (typeof at !== "object" || at === null) return;
    const holder = at as Record<string, unknown>;
    const missing = holder[key] === undefined ? newHolder(keys.slice(0, depth + 1).join(".")) : undefined;
    if (missing) holder[key] = missing;
    at = valueIn(holder, key);
  });
  if (typeof at === "object" && at !== null) (at as Record<string, unknown>)[last] = value;
}

/** The least value and the largest, both allowed. */
type Range = readonly [min: number, max: number];

const aboveZero: Range = [Number.MIN_VALUE, LIMITS.length];
/** Degrees. */
const angle: Range = [1, 180];

/** Ranges of fields; all others have values from 0 to the largest length. They are those of the file and of the fields. */
const ranges: Readonly<Record<string, Range>> = {
  size: aboveZero,
  stretching: [1, LIMITS.stretching],
  secondStretching: [1, LIMITS.stretching],
  growth: [0, LIMITS.growth],
  "placement.scale": aboveZero,
  "remeshing.size": aboveZero,
  "remeshing.minSize": aboveZero,
  "remeshing.maxSize": aboveZero,
  "remeshing.tolerance": aboveZero,
  "remeshing.featureAngle": angle,
  "remeshing.anglePerEdge": angle,
  "remeshing.layers": [0, 100],
  "remeshing.growth": [0, LIMITS.growth],
};

/** Returns whether a number may have a value. Other values of an expression leave the number as it is. */
export function isAllowed({ field }: NumberPath, value: number): boolean {
  const isOfFeature = field.startsWith("features.");
  // The kernel says which numbers of features fit together.
  if (isOfFeature && /\.(count|sides)$/.test(field)) return Number.isInteger(value) && value > 0;
  if (isOfFeature || /position|[dD]irection/.test(field)) return Math.abs(value) <= LIMITS.length;
  // A rotation is a unit quaternion: its parts do not change one by one.
  if (field.startsWith("placement.rotation")) return false;
  const [min, max] = ranges[field] ?? [0, LIMITS.length];
  return value >= min && value <= max;
}
