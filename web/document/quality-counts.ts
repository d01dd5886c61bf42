import type { QualityReport } from "tetrafront";

/** Measures for which a report has a histogram per region. */
export type CountedMeasure = "dihedral" | "radiusRatio" | "edge";

/** Edges are near the target if edge length / target length is in this range. */
export const nearWanted = { from: 0.6, to: 1.5 } as const;
/** Dihedral angles, in degrees, that the optimizer strives for. */
export const wantedAngles = { from: 30, to: 135 } as const;

/** The part of a report that is shown: the id of a region, or null for all regions. */
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

/** Returns the fraction of the counts between two values, both at the edge of a bin. */
export function shareBetween(
  counts: readonly number[],
  binWidth: number,
  { from, to }: { readonly from: number; readonly to: number },
): number {
  const [first, end] = [Math.round(from / binWidth), Math.round(to / binWidth)];
  const all = counts.reduce((sum, count) => sum + count, 0);
  return all === 0 ? 0 : counts.slice(first, end).reduce((sum, count) => sum + count, 0) / all;
}
