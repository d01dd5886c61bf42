import type { QualityReport } from "tetrafront";

/** The measures of which a report has a histogram for each region. */
export type CountedMeasure = "dihedral" | "radiusRatio" | "edge";

/** Edges of these lengths by the wanted ones are as asked for. */
export const nearWanted = { from: 0.6, to: 1.5 } as const;
/** Dihedral angles, in degrees, that the optimizer strives for. */
export const wantedAngles = { from: 30, to: 135 } as const;

/** What is shown of a report: one region, by its number, or null for all of them together. */
export type RegionChoice = number | null;

/** The counts of one region, or of all together. */
export function countsOf(
  { regions }: QualityReport,
  choice: RegionChoice,
  measure: CountedMeasure,
): readonly number[] {
  const chosen = regions.filter(({ region }) => choice === null || region === choice);
  const longest = Math.max(0, ...chosen.map((region) => region[measure].length));
  return Array.from({ length: longest }, (_, bin) =>
    chosen.reduce((sum, region) => sum + (region[measure][bin] ?? 0), 0),
  );
}

/** The share of what is counted in bins between two values, both on the edge of bins. */
export function shareBetween(
  counts: readonly number[],
  binWidth: number,
  { from, to }: { readonly from: number; readonly to: number },
): number {
  const [first, end] = [Math.round(from / binWidth), Math.round(to / binWidth)];
  const all = counts.reduce((sum, count) => sum + count, 0);
  return all === 0 ? 0 : counts.slice(first, end).reduce((sum, count) => sum + count, 0) / all;
}
