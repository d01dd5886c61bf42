/** What the package finds itself, apart from the engine's sentences, which not everyone needs to load. */
import type { DiagnosticCode } from "./diagnostic-codes.js";
import type { Diagnostic, Severity } from "./types.js";

/** A diagnostic that the package raises itself, about no entity in particular. */
export function packageDiagnostic(
  code: DiagnosticCode,
  message: string,
  remedy: string,
  severity: Severity = "error",
): Diagnostic {
  return { code, severity, message: capitalised(message), remedy, entities: [], values: [] };
}

/** A path such as `points[8].id` at the beginning stays as it is. */
export function capitalised(sentence: string): string {
  return sentence.replace(/^[a-z]+(?=[ ,])/, (word) => word.charAt(0).toUpperCase() + word.slice(1));
}
