/** Unpacks the flat arrays in which the engine returns quality statistics. */
import type { ElementQuality, QualityReport, RegionQuality } from "../mesh/quality.js";
import type { EngineRun } from "./loader.js";

type StatisticsRecord = ReturnType<EngineRun["statistics"]>;

/** As in the engine's quality_statistics.h. */
const DIHEDRAL_BINS = 36;
const RATIO_BINS = 20;
const EDGE_BINS = 30;
const REGION_STRIDE = 3;
const ELEMENT_STRIDE = 8;

export const BIN_WIDTHS = { dihedral: 5, radiusRatio: 0.05, edge: 0.1 } as const;

export const NO_QUALITY: QualityReport = {
  binWidths: BIN_WIDTHS,
  regions: [],
  worst: [],
  smallest: null,
  volumeRatio: 0,
  edges: { mean: 0, meanOfAchievable: 0, nearTarget: 0 },
  outOfRange: 0,
  limitedByBoundary: { count: 0, edges: 0, needles: 0, narrowGaps: 0, worst: [] },
};

export function qualityReport(record: StatisticsRecord): QualityReport {
  return {
    binWidths: BIN_WIDTHS,
    regions: regionsOf(record),
    worst: elementsOf(record.worst),
    smallest: elementsOf(record.smallest)[0] ?? null,
    volumeRatio: record.volumeRatio,
    edges: {
      mean: record.meanEdge,
      meanOfAchievable: record.meanEdgeOfAchievable,
      nearTarget: record.edgesNearTarget,
    },
    outOfRange: record.outOfRange,
    limitedByBoundary: {
      count: record.limitedByBoundary,
      edges: record.limitedByEdges,
      needles: record.limitedByNeedles,
      narrowGaps: record.limitedByNarrowGaps,
      worst: elementsOf(record.worstLimited),
    },
  };
}

function regionsOf({ regions, bins }: StatisticsRecord): RegionQuality[] {
  let next = 0;
  const take = (count: number) => Array.from(bins.subarray(next, (next += count)));
  return rowsOf(regions, REGION_STRIDE).map(([region = 0, tetrahedra = 0, volume = 0]) => ({
    region,
    tetrahedra,
    volume,
    dihedral: take(DIHEDRAL_BINS),
    smallestDihedral: take(DIHEDRAL_BINS),
    radiusRatio: take(RATIO_BINS),
    edge: take(EDGE_BINS),
  }));
}

function elementsOf(flat: Float64Array): ElementQuality[] {
  return rowsOf(flat, ELEMENT_STRIDE).map(
    ([tetrahedron = 0, x = 0, y = 0, z = 0, volume = 0, min = 0, max = 0, radiusRatio = 0]) => ({
      tetrahedron,
      centroid: [x, y, z],
      volume,
      dihedral: { min, max },
      radiusRatio,
    }),
  );
}

/** Returns the numbers of a flat array in rows of `stride`. */
export function rowsOf(flat: Float64Array, stride: number): number[][] {
  return Array.from({ length: flat.length / stride }, (_, i) =>
    Array.from(flat.subarray(stride * i, stride * (i + 1))),
  );
}
