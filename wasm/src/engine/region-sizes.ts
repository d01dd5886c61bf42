/** How many elements the regions of a run have, and their volumes. */
import type { QualityReport } from "../mesh/quality.js";
import type { RegionSummary } from "../mesh/report.js";
import type { EngineVolume } from "./engine-mesh.js";

export type RegionSize = Omit<RegionSummary, "name">;

/**
 * Returns number and volume of the tetrahedra of each region of a run, up to the last that has any. The statistics of a
 * finished mesh have them; those of a cancelled one are measured here. O(n), without an object per element: whoever
 * cancelled waits for it.
 */
export function regionSizes(mesh: EngineVolume, { regions: measured }: QualityReport): RegionSize[] {
  if (measured.length > 0) return sizesOf(measured);
  const { points, tetrahedra, regions } = mesh;
  const counts: number[] = [];
  const sixfold: number[] = [];
  const at = (corner: number) => 3 * (tetrahedra[corner] ?? 0);
  const from = (a: number, b: number) => (points[b] ?? 0) - (points[a] ?? 0);
  for (let t = 0; t < regions.length; t++) {
    const region = regions[t] ?? 0;
    const [d, a, b, c] = [at(4 * t + 3), at(4 * t), at(4 * t + 1), at(4 * t + 2)];
    const [ux, uy, uz] = [from(d, a), from(d + 1, a + 1), from(d + 2, a + 2)];
    const [vx, vy, vz] = [from(d, b), from(d + 1, b + 1), from(d + 2, b + 2)];
    const [wx, wy, wz] = [from(d, c), from(d + 1, c + 1), from(d + 2, c + 2)];
    const volume = (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz;
    counts[region] = (counts[region] ?? 0) + 1;
    sixfold[region] = (sixfold[region] ?? 0) + Math.abs(volume);
  }
  return Array.from(counts, (tetrahedra = 0, r) => ({ tetrahedra, volume: (sixfold[r] ?? 0) / 6 }));
}

function sizesOf(measured: QualityReport["regions"]): RegionSize[] {
  const sizes: RegionSize[] = [];
  for (const { region, tetrahedra, volume } of measured)
    if (tetrahedra > 0) sizes[region] = { tetrahedra, volume };
  return Array.from(sizes, (size = { tetrahedra: 0, volume: 0 }) => size);
}
