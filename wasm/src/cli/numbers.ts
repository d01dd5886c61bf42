/** Numbers in the text of options. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { asTypedDiagnostic } from "./command-line-words.js";
import { InvalidInput } from "./messages.js";

/** Decimal notation; 0x10, 1_000 and the empty word are not numbers. */
const DECIMAL = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** Returns the number in an option's text. If there is none, returns the text, which the check of options rejects. */
export function numberIn(text: string | undefined): number | undefined {
  if (text === undefined) return undefined;
  const word = text.trim();
  return DECIMAL.test(word) ? Number(word) : (word as unknown as number);
}

/** Throws the problems found by a check of options. */
export function refuseOptions(wrong: readonly Diagnostic[]): void {
  if (wrong.length > 0) throw new InvalidInput("command line", wrong.map(asTypedDiagnostic));
}
