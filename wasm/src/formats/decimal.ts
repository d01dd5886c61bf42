/** Numbers in the bytes of a text file, without making a string of each. */

const ZERO = 48;
const PLUS = 43;
const MINUS = 45;
const POINT = 46;
/** Whole numbers of so many digits are doubles, and so are the powers of ten below: one rounding is left. */
const EXACT_DIGITS = 15;
const POWERS = Float64Array.from({ length: 23 }, (_, i) => Number(`1e${i}`));

/**
 * The double nearest to the decimal in bytes[begin..end), as `Number` reads it; NaN where it is none.
 * Short decimals are one exact quotient or product of doubles (Clinger 1990); others go to `Number`.
 */
export function decimalIn(bytes: Uint8Array, begin: number, end: number): number {
  let at = begin;
  const sign = bytes[at] ?? 0;
  if (sign === MINUS || sign === PLUS) at++;
  let mantissa = 0;
  let digits = 0;
  let scale = 0;
  let isFraction = false;
  let hasDigit = false;
  for (; at < end; at++) {
    const byte = bytes[at] ?? 0;
    const digit = byte - ZERO;
    if (digit >= 0 && digit <= 9) {
      hasDigit = true;
      mantissa = 10 * mantissa + digit;
      if (mantissa > 0) digits++;
      if (isFraction) scale--;
    } else if (byte === POINT && !isFraction) isFraction = true;
    else break;
  }
  if (!hasDigit) return slowly(bytes, begin, end);
  if (at < end) {
    const exponent = exponentIn(bytes, at, end);
    if (Number.isNaN(exponent)) return slowly(bytes, begin, end);
    scale += exponent;
  }
  if (digits > EXACT_DIGITS || scale < -22 || scale > 22) return slowly(bytes, begin, end);
  const value = scale < 0 ? mantissa / (POWERS[-scale] ?? 1) : mantissa * (POWERS[scale] ?? 1);
  return sign === MINUS ? -value : value;
}

/** The whole number behind an "e", of up to three digits; else NaN. */
function exponentIn(bytes: Uint8Array, begin: number, end: number): number {
  // "E" and "e" differ in one bit.
  if (((bytes[begin] ?? 0) | 32) !== 101) return NaN;
  let at = begin + 1;
  const sign = bytes[at] ?? 0;
  if (sign === MINUS || sign === PLUS) at++;
  if (at === end || end - at > 3) return NaN;
  let value = 0;
  for (; at < end; at++) {
    const digit = (bytes[at] ?? 0) - ZERO;
    if (digit < 0 || digit > 9) return NaN;
    value = 10 * value + digit;
  }
  return sign === MINUS ? -value : value;
}

/** As C and C++ write what is no number, or without bounds; undefined for any other word. */
export function otherNumber(bytes: Uint8Array, begin: number, end: number): number | undefined {
  const word = String.fromCharCode(...bytes.subarray(begin, Math.min(end, begin + LONGEST_OTHER)));
  const [, sign, kind] = OTHER.exec(word) ?? [];
  if (kind === undefined) return undefined;
  return kind.toLowerCase().startsWith("nan") ? NaN : Number(`${sign}Infinity`);
}

/** One more than "-infinity" has; "nan(" may go on for long. */
const LONGEST_OTHER = 10;
const OTHER = /^([+-]?)(nan|nan\(.*|inf|infinity)$/i;

/** No decimal of use is longer: 767 digits decide every double. */
const LONGEST = 1100;
const DECIMAL = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

function slowly(bytes: Uint8Array, begin: number, end: number): number {
  if (end - begin > LONGEST) return NaN;
  const text = String.fromCharCode(...bytes.subarray(begin, end));
  return DECIMAL.test(text) ? Number(text) : NaN;
}
