/** Numbers in text. */

/** Number of significant digits in text. */
export const DIGITS = 6;

export function short(value: number, digits = DIGITS): string {
  return String(Number(value.toPrecision(digits)));
}
