/** Returns the engine's quality statistics in the form of the report. */
import { DIHEDRAL_BIN_WIDTH, EDGE_BIN_WIDTH, POOR_REASONS, RATIO_BIN_WIDTH } from "../generated/constants.js";
import type {
  ElementQuality,
  PoorElements,
  QualityReport,
  RegionQuality,
  ShapeStatistics,
} from "../mesh/quality.js";
import type { EngineStatistics } from "./loader.js";

const BIN_WIDTHS = {
  dihedral: DIHEDRAL_BIN_WIDTH,
  radiusRatio: RATIO_BIN_WIDTH,
  edge: EDGE_BIN_WIDTH,
} as const;

export const NO_QUALITY: QualityReport = {
  binWidths: BIN_WIDTHS,
  regions: [],
  shapes: { dihedral: { min: 0, max: 0 }, radiusRatio: { min: 0, mean: 0 } },
  worst: [],
  smallest: null,
  volumeRatio: 0,
  edges: { mean: 0, meanOfAchievable: 0, nearTarget: 0 },
  outOfRange: 0,
  limitedByBoundary: { count: 0, edges: 0, needles: 0, narrowGaps: 0, worst: [] },
  poor: {
    count: 0,
    inWedges: 0,
    atNeedles: 0,
    inThinPlaces: 0,
    worst: null,
    reason: "other",
    value: 0,
    edge: { from: [0, 0, 0], to: [0, 0, 0] },
    goodSize: 0,
    goodTetrahedra: 0,
  },
};

export function qualityReport(statistics: EngineStatistics): QualityReport {
  const { worst, worstLimited, smallest, volumeRatio, outOfRange, ...rest } = statistics;
  const regions = statistics.regions.map(regionQuality);
  return {
    binWidths: BIN_WIDTHS,
    regions,
    shapes: shapesOfAll(regions),
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
    poor: poorElements(rest.poor),
  };
}

function poorElements(poor: EngineStatistics["poor"]): PoorElements {
  const { edgeFrom: from, edgeTo: to, worst, reason, ...rest } = poor;
  return {
    ...rest,
    worst: rest.count === 0 ? null : elementQuality(worst),
    reason: POOR_REASONS[reason] ?? "other",
    edge: { from, to },
  };
}

function elementQuality(element: EngineStatistics["smallest"]): ElementQuality {
  const { smallestDihedral: min, largestDihedral: max, ...rest } = element;
  return { ...rest, dihedral: { min, max } };
}

function regionQuality(region: EngineStatistics["regions"][number]): RegionQuality {
  const { minDihedral, maxDihedral, minRadiusRatio, meanRadiusRatio, ...rest } = region;
  const dihedral = { min: minDihedral, max: maxDihedral };
  return { ...rest, shapes: { dihedral, radiusRatio: { min: minRadiusRatio, mean: meanRadiusRatio } } };
}

function shapesOfAll(regions: readonly RegionQuality[]): ShapeStatistics {
  const filled = regions.filter(({ tetrahedra }) => tetrahedra > 0);
  if (filled.length === 0) return NO_QUALITY.shapes;
  const dihedrals = filled.map(({ shapes }) => shapes.dihedral);
  const ratios = filled.map(({ shapes }) => shapes.radiusRatio);
  const all = filled.reduce((sum, { tetrahedra }) => sum + tetrahedra, 0);
  const sum = filled.reduce(
    (total, { tetrahedra, shapes }) => total + tetrahedra * shapes.radiusRatio.mean,
    0,
  );
  return {
    dihedral: {
      min: Math.min(...dihedrals.map(({ min }) => min)),
      max: Math.max(...dihedrals.map(({ max }) => max)),
    },
    radiusRatio: { min: Math.min(...ratios.map(({ min }) => min)), mean: sum / all },
  };
}

/** Returns the statistics with other regions. `indices`: per region its new index; several may be one. */
export function withRegions(quality: QualityReport, indices: readonly number[]): QualityReport {
  const found = new Map<number, RegionQuality>();
  for (const one of quality.regions) {
    const region = indices[one.region] ?? one.region;
    const known = found.get(region);
    found.set(region, known === undefined ? { ...one, region } : unitedRegions(known, one));
  }
  return { ...quality, regions: [...found.values()].sort((a, b) => a.region - b.region) };
}

function unitedRegions(one: RegionQuality, other: RegionQuality): RegionQuality {
  const sums = (name: "dihedral" | "smallestDihedral" | "radiusRatio" | "edge") =>
    one[name].map((count, bin) => count + (other[name][bin] ?? 0));
  return {
    region: one.region,
    tetrahedra: one.tetrahedra + other.tetrahedra,
    volume: one.volume + other.volume,
    shapes: shapesOfAll([one, other]),
    dihedral: sums("dihedral"),
    smallestDihedral: sums("smallestDihedral"),
    radiusRatio: sums("radiusRatio"),
    edge: sums("edge"),
  };
}
