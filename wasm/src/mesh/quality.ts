/** Quality statistics of a mesh and its patches. */
import type { PoorReason } from "../generated/constants.js";

/** Quality of the triangulation of one patch of a project or a body. */
export interface PatchQuality {
  /** Index in the project: first the drawn patches, then those of the bodies. */
  readonly patch: number;
  readonly triangles: number;
  /** Degrees, in space. */
  readonly minAngle: number;
  /** 2 × inradius / circumradius, 1 for the equilateral triangle. */
  readonly meanRadiusRatio: number;
  /** Mean of edge length / target length, in the metric of the size field. */
  readonly meanEdge: number;
  /**
   * Largest distance between a triangle and the exact patch, in model units. For a body: the largest distance from its given
   * surface, of seven samples per triangle (`triangleDeviation`); absent if the body was not prepared with it.
   */
  readonly chordDeviation?: number | undefined;
}

/** Quality of one tetrahedron, measured in the metric of the size field (see `QualityReport`). */
export interface ElementQuality {
  /** Index in the volume mesh. */
  readonly tetrahedron: number;
  /** Its centroid. */
  readonly centroid: readonly [number, number, number];
  /** In cubed model units. */
  readonly volume: number;
  /** Degrees. */
  readonly dihedral: { readonly min: number; readonly max: number };
  readonly radiusRatio: number;
}

/** Extremes and mean of the shapes of some elements. */
export interface ShapeStatistics {
  /** Degrees, over all dihedral angles; 0 without elements. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** 3 × inradius / circumradius, 1 for the regular tetrahedron; 0 without elements. */
  readonly radiusRatio: { readonly min: number; readonly mean: number };
}

/** Histograms of one region; bin i counts the values in [i, i + 1) bin widths. */
export interface RegionQuality {
  /** As in `tetrahedronRegion`. */
  readonly region: number;
  readonly tetrahedra: number;
  readonly volume: number;
  readonly shapes: ShapeStatistics;
  /** All six dihedral angles of each tetrahedron. */
  readonly dihedral: readonly number[];
  /** Smallest dihedral angle of each tetrahedron. */
  readonly smallestDihedral: readonly number[];
  readonly radiusRatio: readonly number[];
  /** Edge length / target length of each edge; the last bin also counts all larger values. */
  readonly edge: readonly number[];
}

/**
 * Tetrahedra with a dihedral angle outside 30° to 135° because of the boundary. Each counts under the first of the three
 * reasons that applies.
 */
export interface LimitedByBoundary {
  readonly count: number;
  /**
   * At an edge of the boundary with an inner angle below 30°, or below 60°: one tetrahedron fills it, and another of
   * its angles is then outside the range.
   */
  readonly edges: number;
  /** With an edge of a needle or cap of the boundary. This reason is empirical, not proved. */
  readonly needles: number;
  /**
   * In a gap of the boundary narrower than 0.6 target lengths, without an interior node. This reason is
   * empirical too.
   */
  readonly narrowGaps: number;
  readonly worst: readonly ElementQuality[];
}

/** Tetrahedra with a dihedral angle below 10°, and why the worst of them is poor; without elements in stretched size fields. */
export interface PoorElements {
  readonly count: number;
  /** In wedges: where two faces meet at a small angle, which no element can open. */
  readonly inWedges: number;
  /** At needles and caps of the surface. */
  readonly atNeedles: number;
  /** Where the region is much thinner than the elements are wide. */
  readonly inThinPlaces: number;
  /** The one with the smallest angle; `null` if there is none. The rest is about it. */
  readonly worst: ElementQuality | null;
  readonly reason: PoorReason;
  /** Degrees: angle of the wedge, or smallest angle of the triangle; in model units: thickness; 0 for other reasons. */
  readonly value: number;
  /** Ends of the straight part of the edge of the wedge. */
  readonly edge: {
    readonly from: readonly [number, number, number];
    readonly to: readonly [number, number, number];
  };
  /** Size with which nearly all elements at the thin place would have angles above 10°; 0 for other reasons. */
  readonly goodSize: number;
  /** Number of tetrahedra that the mesh would have with such sizes at all thin places. */
  readonly goodTetrahedra: number;
}

/** Statistics of edge lengths. Target lengths are those asked for, whether or not a given surface allows them. */
export interface EdgeStatistics {
  /** Mean of edge length / target length. */
  readonly mean: number;
  /**
   * Mean of edge length / achievable length. Next to triangles of a given surface that are too large
   * (`coarse-surface`), the achievable length is larger than the target length.
   */
  readonly meanOfAchievable: number;
  /** Fraction of edges between 0.6 and 1.5 target lengths. */
  readonly nearTarget: number;
}

/**
 * Statistics of the elements of a finished mesh. Shapes and lengths are measured in the metric of the size field: if it is
 * stretched, in the space where the target element is regular with edge 1.
 */
export interface QualityReport {
  /** Degrees for angles. */
  readonly binWidths: { readonly dihedral: number; readonly radiusRatio: number; readonly edge: number };
  readonly regions: readonly RegionQuality[];
  /** Shapes of all elements. */
  readonly shapes: ShapeStatistics;
  /** Up to ten elements, those with the worst angles first. */
  readonly worst: readonly ElementQuality[];
  /** Element with the smallest volume. */
  readonly smallest: ElementQuality | null;
  /** Largest volume / smallest volume. */
  readonly volumeRatio: number;
  /** Statistics of all edges. */
  readonly edges: EdgeStatistics;
  /** Number of tetrahedra with a dihedral angle outside 30° to 135°, except those limited by the boundary. */
  readonly outOfRange: number;
  /** Tetrahedra that the boundary forces to have such angles. */
  readonly limitedByBoundary: LimitedByBoundary;
  readonly poor: PoorElements;
}

/** Shapes of all elements, measured in the metric of a stretched size field; one number per element each. */
export interface MetricShapes {
  readonly radiusRatio: Float32Array;
  /** Degrees. */
  readonly smallestDihedral: Float32Array;
}
