/** Returns the engine's quality statistics in the form of the report. */
import { DIHEDRAL_BIN_WIDTH, EDGE_BIN_WIDTH, RATIO_BIN_WIDTH } from "../generated/constants.js";
import type { ElementQuality, QualityReport } from "../mesh/quality.js";
import type { EngineStatistics } from "./loader.js";

const BIN_WIDTHS = {
  dihedral: DIHEDRAL_BIN_WIDTH,
  radiusRatio: RATIO_BIN_WIDTH,
  edge: EDGE_BIN_WIDTH,
} as const;

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

export function qualityReport(statistics: EngineStatistics): QualityReport {
  const { regions, worst, worstLimited, smallest, volumeRatio, outOfRange, ...rest } = statistics;
  return {
    binWidths: BIN_WIDTHS,
    regions,
    worst: worst.map(elementQuality),
    smallest: worst.length === 0 ? null : elementQuality(smallest),
    volumeRatio,
    edges: {
      mean: rest.meanEdge,
      meanOfAchievable: rest.meanEdgeOfAchievable,
      nearTarget: rest.edgesNearTarget,
    },
    outOfRange,
    limitedByBoundary: {
      count: rest.limitedByBoundary,
      edges: rest.limitedByEdges,
      needles: rest.limitedByNeedles,
      narrowGaps: rest.limitedByNarrowGaps,
      worst: worstLimited.map(elementQuality),
    },
  };
}

function elementQuality(element: EngineStatistics["smallest"]): ElementQuality {
  const { smallestDihedral: min, largestDihedral: max, ...rest } = element;
  return { ...rest, dihedral: { min, max } };
}
