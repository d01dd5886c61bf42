/** Parses decimal numbers in the bytes of a text file without creating a string for each. */

const ZERO = 48;
const PLUS = 43;
const MINUS = 45;
const POINT = 46;
const LETTER_D = 100;
const LETTER_E = 101;
/**
 * Whole numbers of up to this many digits, and the powers of ten below, are exact doubles: only one rounding
 * remains.
 */
const EXACT_DIGITS = 15;
const POWERS = Float64Array.from({ length: 23 }, (_, i) => Number(`1e${i}`));

/**
 * Returns the double nearest to the decimal in bytes[begin..end), like `Number`; NaN if it is not a decimal. A
 * short decimal is one exact quotient or product of doubles (Clinger 1990); any other is passed to `Number`.
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

/** Parses an exponent of up to three digits, with its letter; NaN if it is invalid. */
function exponentIn(bytes: Uint8Array, begin: number, end: number): number {
  // Capital letters differ in one bit. Fortran writes "D" for double precision.
  const letter = (bytes[begin] ?? 0) | 32;
  if (letter !== LETTER_E && letter !== LETTER_D) return NaN;
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

/** Parses the words that C and C++ write for NaN and infinities; undefined for any other word. */
export function otherNumber(bytes: Uint8Array, begin: number, end: number): number | undefined {
  const word = String.fromCharCode(...bytes.subarray(begin, Math.min(end, begin + MAX_OTHER_LENGTH)));
  const [, sign, kind] = OTHER.exec(word) ?? [];
  if (kind === undefined) return undefined;
  return kind.toLowerCase().startsWith("nan") ? NaN : Number(`${sign}Infinity`);
}

/** One more than the length of "-infinity"; "nan(…" may be of any length. */
const MAX_OTHER_LENGTH = 10;
const OTHER = /^([+-]?)(nan|nan\(.*|inf|infinity)$/i;

/** Longer words are rejected: 767 digits decide every double. */
const MAX_DECIMAL_LENGTH = 1100;
const DECIMAL = /^[+-]?(\d+\.?\d*|\.\d+)([ed][+-]?\d+)?$/i;

function slowly(bytes: Uint8Array, begin: number, end: number): number {
  if (end - begin > MAX_DECIMAL_LENGTH) return NaN;
  const text = String.fromCharCode(...bytes.subarray(begin, end));
  return DECIMAL.test(text) ? Number(text.replace(/d/i, "e")) : NaN;
}
