/** Parts that the schemas of a project share. */
import * as v from "valibot";
import { WORDS } from "./words.js";

/** Adds the meaning of a field to the JSON Schema. */
export const described = <Schema extends v.GenericSchema>(description: string, schema: Schema) =>
  v.pipe(schema, v.description(description));

export const listOf = <Item extends v.GenericSchema>(item: Item) => v.pipe(v.array(item), v.readonly());

export const number = v.pipe(v.number(), v.finite());
/** The engine would reject a larger number without naming the field. */
export const upTo = (max: number) => v.pipe(number, v.maxValue(max));
export const integer = v.pipe(v.number(), v.safeInteger());

export const reference = v.pipe(integer, v.gtValue(0));
export const id = described(WORDS.id, reference);
export const name = v.optional(described(WORDS.name, v.string()));
export const threeNumbers = v.pipe(v.strictTuple([number, number, number]), v.readonly());

const part = v.pipe(number, v.minValue(0), v.maxValue(1));
/** Red, green and blue. */
export const color = v.pipe(v.strictTuple([part, part, part]), v.readonly());

/** Path of keys and indices from a project to a part of it. */
export type Path = (string | number)[];
export type Report = (path: Path, message: string) => void;

/** Returns the ids of entities, and reports those that are used twice. */
export function uniqueIds(
  entities: readonly { readonly id: number }[],
  path: Path,
  kind: string,
  report: Report,
  seen = new Set<number>(),
): ReadonlySet<number> {
  entities.forEach((entity, index) => {
    if (seen.has(entity.id)) report([...path, index, "id"], `another ${kind} also has the id ${entity.id}`);
    seen.add(entity.id);
  });
  return seen;
}
