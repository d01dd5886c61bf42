/** What the package finds itself, apart from the engine's sentences, which not everyone needs to load. */
import type { DiagnosticCode, EngineCode } from "./codes.js";
import type { ReadProblem } from "../formats/read-result.js";
import type { Diagnostic, DiagnosticOf, Severity } from "../api/types.js";

/** A diagnostic that the package raises itself, about no entity in particular. */
export function packageDiagnostic(
  code: Exclude<DiagnosticCode, EngineCode | "invalid-option">,
  message: string,
  remedy: string,
  severity: Severity = "error",
): Diagnostic {
  return { code, severity, message: sentence(message), remedy, entities: [], data: {} };
}

/** `option`: its name where it was given, `options` for all of them. */
export function invalidOption(
  option: string,
  message: string,
  remedy: string,
): DiagnosticOf<"invalid-option"> {
  const code = "invalid-option";
  return { code, severity: "error", message: sentence(message), remedy, entities: [], data: { option } };
}

/** Why something could not be read, where one problem is told among others. */
export function readDiagnostic({ code, message, remedy, ...place }: ReadProblem): Diagnostic {
  return { ...packageDiagnostic(code, message, remedy), data: place } as Diagnostic;
}

/** Readable signs only, and a capital to begin with; a path such as `points[8].id` at the beginning stays as it is. */
export function sentence(message: string): string {
  return printable(message).replace(
    /^[a-z]+(?=[ ,])/,
    (word) => word.charAt(0).toUpperCase() + word.slice(1),
  );
}

/** Control characters, ends of lines and paragraphs, and what turns the direction of what follows. */
const UNPRINTABLE = /[\p{Cc}\u2028\u2029\u200e\u200f\u202a-\u202e\u2066-\u2069]/gu;

/**
 * The text with `\u001b` and the like in place of what is no character to read: a name in a file may hold any, and a
 * terminal obeys them.
 */
export function printable(text: string): string {
  return text.replace(
    UNPRINTABLE,
    (character) => `\\u${character.charCodeAt(0).toString(16).padStart(4, "0")}`,
  );
}
