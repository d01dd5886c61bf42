/**
 * What functions of the public API ask of their arguments, as callers without type checks may give anything: checks that
 * name the value at fault, and one way to refuse it.
 */
import { isA, isArrayOf, isDetached, shown } from "../base/values.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";

/** What is wrong with a value, as it follows its name: " is 5, …" or ".points is …"; undefined where nothing is. */
export type Check = (value: unknown) => string | undefined;

/** Throws a MesherError that tells what is wrong with the argument of this name. */
export function checkArgument(name: string, value: unknown, check: Check): void {
  const wrong = check(value);
  if (wrong === undefined) return;
  const remedy = "The types of the package tell what it takes.";
  refuse([packageDiagnostic("invalid-argument", `the argument ${name}${wrong}`, remedy)]);
}

function is(test: (value: unknown) => boolean, wanted: string): Check {
  return (value) => (test(value) ? undefined : ` is ${shown(value)}, and should be ${wanted}`);
}

export const aString = is((value) => typeof value === "string", "a string");
export const aNumber = is((value) => typeof value === "number", "a number");
export const aPosition = is(
  (value) => Number.isInteger(value) && Number(value) >= 0,
  "a whole number from 0 on",
);
export const aFunction = is((value) => typeof value === "function", "a function");
export const aMap = is((value) => isA("Map", value), "a Map");

export function oneOf(known: readonly string[]): Check {
  return is((value) => known.includes(value as string), `one of ${known.join(", ")}`);
}

export function orNothing(check: Check): Check {
  return (value) => (value === undefined ? undefined : check(value));
}

/** Checks the fields that are named; others may be there too. */
export function objectOf(fields: Readonly<Record<string, Check>>): Check {
  const checks = Object.entries(fields);
  return (value) => {
    if (typeof value !== "object" || value === null) return ` is ${shown(value)}, and should be an object`;
    for (const [field, check] of checks) {
      const wrong = check((value as Readonly<Record<string, unknown>>)[field]);
      if (wrong !== undefined) return `.${field}${wrong}`;
    }
    return undefined;
  };
}

export function listOf(check: Check): Check {
  return (value) => {
    if (!Array.isArray(value)) return ` is ${shown(value)}, and should be a list`;
    for (let i = 0; i < value.length; i++) {
      const wrong = check(value[i]);
      if (wrong !== undefined) return `[${i}]${wrong}`;
    }
    return undefined;
  };
}

/** Numbers in a typed array, so many for each thing. */
export function arrayOf(type: typeof Float64Array | typeof Uint32Array, stride = 1): Check {
  return (value) => {
    if (!isArrayOf<Float64Array | Uint32Array>(type, value))
      return ` is ${shown(value)}, and should be a ${type.name}`;
    if (isDetached(value)) return " was transferred, and its numbers are gone";
    if (value.length % stride !== 0)
      return ` has ${value.length} numbers, and should have ${stride} for each`;
    return undefined;
  };
}
