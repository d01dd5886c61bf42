import { LIMITS, type Project, type ProjectExpression } from "tetrafront";
import { recordsOf, type Entity } from "./entities";

/** One number of an entity: the subject of an expression. */
export type NumberPath = Pick<ProjectExpression, "kind" | "id" | "field">;

export const pathKey = ({ kind, id, field }: NumberPath): string => `${kind}-${id}-${field}`;

/** Returns a function that finds the records of a project by kind and id; it indexes each kind once. */
export function recordFinder(project: Project): (entity: Entity) => object | undefined {
  const indices = new Map<string, ReadonlyMap<number, object>>();
  return ({ kind, id }) => {
    let index = indices.get(kind);
    if (!index) {
      index = new Map(recordsOf(project, kind).map((record) => [record.id, record]));
      indices.set(kind, index);
    }
    return index.get(id);
  };
}

/** Returns the number at a path of fields in a record, such as `position.0`; undefined if there is none. */
export function numberAt(record: object | undefined, field: string): number | undefined {
  let at: unknown = record;
  for (const key of field.split(".")) {
    if (typeof at !== "object" || at === null) return undefined;
    at = (at as Readonly<Record<string, unknown>>)[key];
  }
  return typeof at === "number" ? at : undefined;
}

/** Sets the number at a path of fields in a draft of a record. Does nothing if what should hold the number is missing. */
export function setNumberAt(record: object | undefined, field: string, value: number): void {
  const keys = field.split(".");
  const last = keys.pop() ?? "";
  let at: unknown = record;
  for (const key of keys) {
    at = typeof at === "object" && at !== null ? (at as Record<string, unknown>)[key] : undefined;
  }
  if (typeof at === "object" && at !== null) (at as Record<string, unknown>)[last] = value;
}

/** Largest values of fields that have a limit of their own. */
const limits: Readonly<Record<string, number>> = {
  growth: LIMITS.growth,
  stretching: LIMITS.stretching,
};

/** Fields whose numbers must be above zero. */
const positive: ReadonlySet<string> = new Set(["size", "placement.scale"]);

/** Returns whether a number may have a value. Other values of an expression leave the number as it is. */
export function isAllowed({ kind, field }: NumberPath, value: number): boolean {
  if (positive.has(field) && value <= 0) return false;
  if (field === "stretching") return value >= 1 && value <= LIMITS.stretching;
  const isPosition = /position|direction/.test(field);
  if (isPosition) return Math.abs(value) <= LIMITS.length;
  // Remeshing has limits of its own for angles, layers and growth, which only its fields know.
  if (kind === "body" && field.startsWith("remeshing.")) return false;
  if (field.startsWith("placement.rotation")) return false;
  return value >= 0 && value <= (limits[field] ?? LIMITS.length);
}
