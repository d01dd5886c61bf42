/**
 * Checks values of unknown type against schemas of the library Valibot, and describes what is wrong. Callers
 * without type checks may pass anything.
 */
import * as v from "valibot";
import { isA, isArrayOf, isDetached, shown } from "../base/values.js";

/** An invalid part of a value, and its location there: `points[0].position[2]`. */
export interface SchemaProblem {
  readonly path: string;
  readonly message: string;
}

/**
 * Returns the value with the type of its schema, or its problems. Of the unknown keys of an object, only the first
 * is reported.
 */
export function parsedBy<const Schema extends v.GenericSchema>(
  schema: Schema,
  value: unknown,
): { readonly value: v.InferOutput<Schema> } | { readonly problems: readonly SchemaProblem[] } {
  // Set the options in each call, because the page may have other global settings for its own schemas.
  const parsed = v.safeParse(schema, value, { abortEarly: false, abortPipeEarly: true });
  return parsed.success ? { value: parsed.output } : { problems: parsed.issues.map(problemOf) };
}

/** Returns the first problem of a value; undefined if it is valid. */
export function problemIn(schema: v.GenericSchema, value: unknown): SchemaProblem | undefined {
  const parsed = v.safeParse(schema, value, { abortEarly: true });
  return parsed.success ? undefined : problemOf(parsed.issues[0]);
}

function problemOf(issue: v.BaseIssue<unknown>): SchemaProblem {
  const keys = issue.path?.map(({ key }) => key) ?? [];
  // Report an unknown key as a problem of the object that has it.
  const surplus = issue.expected === "never" ? keys.pop() : undefined;
  return {
    path: pathText(keys),
    message: surplus === undefined ? wordsFor(issue) : wordsForSurplus(surplus),
  };
}

function wordsForSurplus(key: unknown): string {
  return typeof key === "number" ? `expected at most ${key}${ITEMS}` : `there is no key ${shown(key)}`;
}

function wordsFor({ kind, type, input, expected, requirement, message }: v.BaseIssue<unknown>): string {
  if (kind === "schema" && input === undefined) return "it is missing";
  switch (type) {
    case "raw_check":
    case "check":
      return message;
    case "custom":
    case "regex":
      return `expected ${message}, received ${shown(input)}`;
    case "safe_integer":
      return `expected a whole number, received ${shown(input)}`;
    case "gt_value":
      return `expected more than ${shown(requirement)}`;
    case "min_value":
      return `expected at least ${shown(requirement)}`;
    case "max_value":
      return `expected at most ${shown(requirement)}`;
    case "min_length":
      return `expected at least ${shown(requirement)}${unitOf(input)}`;
    case "max_length":
      return `expected at most ${shown(requirement)}${unitOf(input)}`;
    case "picklist":
      return `expected one of ${expected?.slice(1, -1).replaceAll(" | ", ", ")}`;
    default:
      return `expected ${NAMES[type] ?? expected}, received ${shown(input)}`;
  }
}

const ITEMS = " items";
const unitOf = (input: unknown): string => (typeof input === "string" ? " characters" : ITEMS);
const NAMES: Readonly<Record<string, string>> = {
  array: "a list",
  boolean: "true or false",
  finite: "a finite number",
  function: "a function",
  number: "a number",
  object: "an object",
  strict_object: "an object",
  strict_tuple: "a list",
  string: "a string",
};

/** Converts `["points", 0, "position", 2]` to `points[0].position[2]`. */
function pathText(path: readonly unknown[]): string {
  return path
    .map((step) => (typeof step === "number" ? `[${step}]` : `.${String(step)}`))
    .join("")
    .replace(/^\./, "");
}

/** Like v.strictObject, but rejects arrays, which v.strictObject accepts if no field is required. */
export function objectWith<const Entries extends v.ObjectEntries>(
  entries: Entries,
): v.StrictObjectSchema<Entries, undefined> {
  const schema = v.strictObject(entries);
  return {
    ...schema,
    "~run"(dataset, config) {
      if (!Array.isArray(dataset.value)) return schema["~run"](dataset, config);
      v._addIssue(schema, "type", dataset, config);
      return dataset as unknown as v.FailureDataset<v.StrictObjectIssue>;
    },
  };
}

/** A Float64Array with `stride` numbers per entity. */
export const doubles = (stride = 1) => typedArray<Float64Array>(Float64Array, stride);
/** A Uint32Array with `stride` numbers per entity. */
export const integers = (stride = 1) => typedArray<Uint32Array>(Uint32Array, stride);

function typedArray<T extends Float64Array | Uint32Array>(
  type: { readonly name: string; readonly prototype: T },
  stride: number,
) {
  return v.pipe(
    v.custom<T>((value) => isArrayOf(type, value), `a ${type.name}`),
    v.check((array) => !isDetached(array), "its buffer was transferred, so its numbers are gone"),
    v.check(({ length }) => length % stride === 0, `its length is not a multiple of ${stride}`),
  );
}

/** A Map of any realm. */
export const map = v.custom<ReadonlyMap<unknown, unknown>>((value) => isA("Map", value), "a Map");

/** An index of an array: a whole number from 0. */
export const index = v.custom<number>(
  (value) => Number.isInteger(value) && Number(value) >= 0,
  "a whole number from 0 on",
);

/** Entries of an object that follow and cancel a call; an AbortSignal of any realm. */
export const watch = {
  onProgress: v.optional(v.function()),
  signal: v.optional(v.object({ addEventListener: v.function(), removeEventListener: v.function() })),
};
