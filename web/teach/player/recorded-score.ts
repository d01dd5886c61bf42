/** Binary digits of a score in a trace: the upper two bytes of a float have 8, with the leading one (docs/TRACE.md). */
const binaryDigits = 8;

/** Returns how many decimals of a score of a trace are right, so that it has two or three digits. */
function decimalsOf(score: number): number {
  const spacing = 2 ** (Math.floor(Math.log2(Math.abs(score))) + 1 - binaryDigits);
  return Math.max(0, Math.floor(-Math.log10(spacing)));
}

/**
 * Returns scores of a trace in a column, all with the same number of decimals: as many as are right in each of them, or more if
 * different scores would look equal.
 */
export function recordedScores(scores: readonly number[]): readonly string[] {
  const decimals = scores.filter((score) => score !== 0).map(decimalsOf);
  const most = Math.max(0, ...decimals);
  const withDecimals = (count: number): string[] => scores.map((score) => score.toFixed(count));
  const different = new Set(scores).size;
  for (let count = Math.min(most, ...decimals); count < most; count++) {
    const texts = withDecimals(count);
    if (new Set(texts).size === different) return texts;
  }
  return withDecimals(most);
}
