/** Refuses invalid arguments of functions of the public API. */
import type * as v from "valibot";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { problemIn } from "./schemas.js";

/** Throws a `MesherError` if the argument does not follow its schema. */
export function checkArgument(name: string, value: unknown, schema: v.GenericSchema): void {
  const problem = problemIn(schema, value);
  if (problem === undefined) return;
  const { path, message } = problem;
  const where = path === "" ? name : path.startsWith("[") ? `${name}${path}` : `${name}.${path}`;
  const remedy = "Pass a value of the type that the package declares.";
  refuse([packageDiagnostic("invalid-argument", `the argument ${where} is invalid: ${message}`, remedy)]);
}
