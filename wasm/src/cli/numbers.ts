/** Numbers in the text of options. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
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

/** Returns a diagnostic if a number that counts is neither 0 nor within a range. */
export function countProblems(
  option: string,
  count: number | undefined,
  [min, max]: readonly [min: number, max: number],
  what = "",
): Diagnostic[] {
  if (count === undefined || count === 0 || (count >= min && count <= max)) return [];
  const range = `${min === 0 ? "" : "0 or "}a number from ${min} to ${max}`;
  return [invalidOption(option, `${option} is ${count}`, `Use ${range}${what}; 0 means no limit.`)];
}

/** Throws the problems found by a check of options. */
export function refuseOptions(wrong: readonly Diagnostic[]): void {
  if (wrong.length > 0) throw new InvalidInput("command line", wrong.map(asTypedDiagnostic));
}
