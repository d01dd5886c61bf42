/** How many elements the regions of a run have, and their volumes. */
import { sixfoldVolume } from "../formats/sixfold-volume.js";
import type { QualityReport } from "../mesh/quality.js";
import type { RegionSummary } from "../mesh/report.js";
import type { EngineVolume } from "./engine-mesh.js";

export type RegionStatistics = Omit<RegionSummary, "name">;

/**
 * Returns number and volume of the tetrahedra of each region of a run, up to the last that has any. The statistics of a finished
 * mesh have them; those of a cancelled one are measured here. O(n): the user who cancelled waits for it.
 */
export function regionStatistics(
  { points, tetrahedra, regions }: EngineVolume,
  { regions: measured }: QualityReport,
): RegionStatistics[] {
  if (measured.length > 0) return statisticsOf(measured);
  const counts: number[] = [];
  const sixfold: number[] = [];
  const corner = (index: number) => tetrahedra[index] ?? 0;
  for (let t = 0; t < regions.length; t++) {
    const region = regions[t] ?? 0;
    const { volume } = sixfoldVolume(
      points,
      corner(4 * t),
      corner(4 * t + 1),
      corner(4 * t + 2),
      corner(4 * t + 3),
    );
    counts[region] = (counts[region] ?? 0) + 1;
    sixfold[region] = (sixfold[region] ?? 0) + Math.abs(volume);
  }
  return Array.from(counts, (count = 0, r) => ({ tetrahedra: count, volume: (sixfold[r] ?? 0) / 6 }));
}

function statisticsOf(measured: QualityReport["regions"]): RegionStatistics[] {
  const statistics: RegionStatistics[] = [];
  for (const { region, tetrahedra, volume } of measured)
    if (tetrahedra > 0) statistics[region] = { tetrahedra, volume };
  return Array.from(statistics, (one = { tetrahedra: 0, volume: 0 }) => one);
}
