import type { QualityReport } from "tetrafront";
import type { ShapeStatistics } from "tetrafront/internal";

/** Measures for which a report has a histogram per region. */
export type CountedMeasure = "dihedral" | "radiusRatio" | "edge";

export interface Range {
  readonly from: number;
  readonly to: number;
}

/** Edges are near the target if edge length / target length is in this range. */
export const nearTarget: Range = { from: 0.6, to: 1.5 };
/** Dihedral angles that the optimizer aims at, in degrees. */
export const targetAngles: Range = { from: 30, to: 135 };

/** The part of a report that is shown: the id of a region, or null for all regions. */
export type RegionChoice = number | null;

/** Returns the histogram of one region, or the sum over all regions. */
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
export function shareBetween(counts: readonly number[], binWidth: number, { from, to }: Range): number {
  const [first, end] = [Math.round(from / binWidth), Math.round(to / binWidth)];
  const all = counts.reduce((sum, count) => sum + count, 0);
  return all === 0 ? 0 : counts.slice(first, end).reduce((sum, count) => sum + count, 0) / all;
}

/** Returns the extremes and the mean of the shapes of one region, or of all regions. */
export function shapesOf({ regions, shapes }: QualityReport, choice: RegionChoice): ShapeStatistics {
  return regions.find(({ region }) => region === choice)?.shapes ?? shapes;
}
