/**
 * Diagnostics of the package itself. They are separate from the engine's sentences, so that callers who need
 * only these do not load the engine's.
 */
import type { EngineCode, Severity } from "../generated/constants.js";
import type { DiagnosticCode } from "./codes.js";
import type { Diagnostic, DiagnosticOf } from "./diagnostic.js";
import type { ReadError } from "./read-error.js";

export function invalidArrays(message: string, remedy: string): Diagnostic {
  return packageDiagnostic("invalid-arrays", message, remedy);
}

type DiagnosticWithData =
  | "deviation-above-tolerance"
  | "changed-volume"
  | "invalid-option"
  | "near-nodes"
  | "needle-surface"
  | "poor-elements"
  | "required-angle";

/** Returns a diagnostic of the package about no particular entity. */
export function packageDiagnostic(
  code: Exclude<DiagnosticCode, EngineCode | DiagnosticWithData>,
  message: string,
  remedy: string,
  severity: Severity = "error",
): Diagnostic {
  // The compiler does not compare so many codes one by one.
  return { code, severity, message: sentence(message), remedy, entities: [], data: {} } as Diagnostic;
}

/** `option`: its name as given, or `options` for all of them. */
export function invalidOption(
  option: string,
  message: string,
  remedy: string,
): DiagnosticOf<"invalid-option"> {
  const code = "invalid-option";
  return { code, severity: "error", message: sentence(message), remedy, entities: [], data: { option } };
}

/** Returns a read error as a diagnostic, for use in a list of diagnostics. */
export function readDiagnostic({ code, message, remedy, ...location }: ReadError): Diagnostic {
  return { ...packageDiagnostic(code, message, remedy), data: location } as Diagnostic;
}

/** Makes a message printable and capitalizes its first word; a path such as `points[8].id` at the beginning is kept. */
export function sentence(message: string): string {
  return printable(message).replace(
    /^[a-z]+(?=[ ,])/,
    (word) => word.charAt(0).toUpperCase() + word.slice(1),
  );
}

/** Control characters, ends of lines and paragraphs, and characters that change the direction of text. */
const UNPRINTABLE = /[\p{Cc}\u2028\u2029\u200e\u200f\u202a-\u202e\u2066-\u2069]/gu;

/**
 * Escapes unprintable characters as `\u001b` and the like: a name in a file may contain any, and a terminal would
 * obey them.
 */
export function printable(text: string): string {
  return text.replace(
    UNPRINTABLE,
    (character) => `\\u${character.charCodeAt(0).toString(16).padStart(4, "0")}`,
  );
}
