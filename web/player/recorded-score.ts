/** Binary digits of a score in a trace: the upper two bytes of a float have 8, with the leading one (docs/TRACE.md). */
const binaryDigits = 8;

/** Returns a score of a trace with the decimal digits that it has: two or three. */
export function recordedScore(score: number): string {
  if (score === 0) return "0";
  const spacing = 2 ** (Math.floor(Math.log2(Math.abs(score))) + 1 - binaryDigits);
  return score.toFixed(Math.max(0, Math.floor(-Math.log10(spacing))));
}
