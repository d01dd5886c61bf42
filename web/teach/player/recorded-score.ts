/** Scores of a trace with the digits that are right, and their parts with the same decimals. */
import type { TracedCandidate } from "tetrafront/trace";

/** Binary digits of a score with its parts: the upper three bytes of a float have 16, with the leading one (docs/TRACE.md). */
const binaryDigits = 16;
/** Those of a score in earlier files, of two bytes. */
const fewBinaryDigits = 8;
/** More are not worth reading. */
const maxDecimals = 3;

/** Returns how many decimals of a score of a trace are right. */
function decimalsOf({ score, parts }: RecordedScore): number {
  const digits = parts === null ? fewBinaryDigits : binaryDigits;
  const spacing = 2 ** (Math.floor(Math.log2(Math.abs(score))) + 1 - digits);
  return Math.min(maxDecimals, Math.max(0, Math.floor(-Math.log10(spacing))));
}

type RecordedScore = Pick<TracedCandidate, "score" | "parts">;

/**
 * Returns scores of a trace in a column, all with the same number of decimals: as many as are right in each of them, or more if
 * different scores would look equal.
 */
export function recordedScores(recorded: readonly RecordedScore[]): readonly string[] {
  const decimals = recorded.filter(({ score }) => score !== 0).map(decimalsOf);
  const most = Math.max(0, ...decimals);
  const withDecimals = (count: number): string[] => recorded.map(({ score }) => score.toFixed(count));
  const different = new Set(recorded.map(({ score }) => score)).size;
  for (let count = Math.min(most, ...decimals); count < most; count++) {
    const texts = withDecimals(count);
    if (new Set(texts).size === different) return texts;
  }
  return withDecimals(most);
}

/**
 * Returns the parts of a score with some decimals, such that their sum is the score with as many decimals. Each differs from its part
 * by less than one unit of the last decimal, and parts of 0 stay 0.
 */
export function roundedParts<Name extends string>(
  parts: Readonly<Record<Name, number>>,
  decimals: number,
): Readonly<Record<Name, number>> {
  const units = 10 ** decimals;
  const names = (Object.keys(parts) as Name[]).filter((name) => parts[name] !== 0);
  const total = names.reduce((sum, name) => sum + parts[name], 0);
  const rounded: Record<Name, number> = { ...parts };
  const restOf = (name: Name): number => parts[name] * units - Math.floor(parts[name] * units);
  let missing = Math.round(total * units);
  for (const name of names) missing -= Math.floor(parts[name] * units);
  // Those that lose most by rounding down are rounded up.
  const byRest = [...names].sort((a, b) => restOf(b) - restOf(a));
  byRest.forEach((name, rank) => {
    rounded[name] = (Math.floor(parts[name] * units) + (rank < missing ? 1 : 0)) / units;
  });
  return rounded;
}
