/** What the package finds itself, apart from the engine's sentences, which not everyone needs to load. */
import type { DiagnosticCode, EngineCode } from "./diagnostic-codes.js";
import type { ReadProblem } from "./read-result.js";
import type { Diagnostic, DiagnosticOf, Severity } from "./types.js";

/** A diagnostic that the package raises itself, about no entity in particular. */
export function packageDiagnostic(
  code: Exclude<DiagnosticCode, EngineCode | "invalid-option">,
  message: string,
  remedy: string,
  severity: Severity = "error",
): Diagnostic {
  return { code, severity, message: capitalised(message), remedy, entities: [], data: {} };
}

/** `option`: its name where it was given, `options` for all of them. */
export function invalidOption(
  option: string,
  message: string,
  remedy: string,
): DiagnosticOf<"invalid-option"> {
  const code = "invalid-option";
  return { code, severity: "error", message: capitalised(message), remedy, entities: [], data: { option } };
}

/** Why something could not be read, where one problem is told among others. */
export function readDiagnostic({ code, message, remedy, ...place }: ReadProblem): Diagnostic {
  return { ...packageDiagnostic(code, message, remedy), data: place } as Diagnostic;
}

/** A path such as `points[8].id` at the beginning stays as it is. */
export function capitalised(sentence: string): string {
  return sentence.replace(/^[a-z]+(?=[ ,])/, (word) => word.charAt(0).toUpperCase() + word.slice(1));
}
