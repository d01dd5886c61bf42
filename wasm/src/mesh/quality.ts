/** Quality statistics of a mesh and its patches. */

/** The triangulation of one patch of a project. */
export interface PatchQuality {
  /** Position in the project. */
  readonly patch: number;
  readonly triangles: number;
  /** Degrees, in space. */
  readonly minAngle: number;
  /** 2 × inradius / circumradius, 1 for the equilateral triangle. */
  readonly meanRadiusRatio: number;
  /** Length over the wanted one, in the metric: 1 is as asked for. */
  readonly meanEdge: number;
  /** Largest distance between a triangle and the true patch, in model units. */
  readonly chordDeviation: number;
}

/** One tetrahedron of the report. Shapes are those the size field sees (see `QualityReport`). */
export interface ElementQuality {
  /** Position in the volume mesh. */
  readonly tetrahedron: number;
  /** Its centroid. */
  readonly centroid: readonly [number, number, number];
  /** In cubed model units. */
  readonly volume: number;
  /** Degrees. */
  readonly dihedral: { readonly min: number; readonly max: number };
  readonly radiusRatio: number;
}

/** Histograms over one region; bin i counts what is in [i, i + 1) bin widths. */
export interface RegionQuality {
  /** As in `VolumeMesh.regions`. */
  readonly region: number;
  readonly tetrahedra: number;
  readonly volume: number;
  /** Of all six dihedral angles of each tetrahedron. */
  readonly dihedral: readonly number[];
  /** Of the smallest of each. */
  readonly smallestDihedral: readonly number[];
  readonly radiusRatio: readonly number[];
  /** Of each edge's length by the wanted one; the last bin also counts all longer ones. */
  readonly edge: readonly number[];
}

/** Each tetrahedron counts under the first of the three reasons that applies. */
export interface LimitedByBoundary {
  readonly count: number;
  /**
   * Forced by an edge of the boundary: the inside takes less than 30° there, or less than 60°, which
   * one tetrahedron only can fill, and that one has other angles beyond.
   */
  readonly edges: number;
  /** With an edge of a needle or cap among the boundary's triangles: experience, not proof. */
  readonly needles: number;
  /**
   * Between two parts of the boundary nearer to each other than 0.6 wanted lengths, without a node
   * inside: neither a proof.
   */
  readonly narrowGaps: number;
  readonly worst: readonly ElementQuality[];
}

/** Lengths of edges. Wanted are those asked for, whether a given surface allows them or not. */
export interface EdgeStatistics {
  /** The mean of length by wanted length. */
  readonly mean: number;
  /**
   * The mean of length by the length wanted of the front: longer beside triangles of a given surface that
   * are too large (`coarse-surface`), the same everywhere else.
   */
  readonly meanOfAchievable: number;
  /** The share of edges between 0.6 and 1.5 wanted lengths. */
  readonly nearTarget: number;
}

/**
 * The elements of a finished mesh. Shapes and lengths are those the size field sees: where it is
 * stretched, in the space where the wanted element is regular with edge 1.
 */
export interface QualityReport {
  /** Degrees for angles. */
  readonly binWidths: { readonly dihedral: number; readonly radiusRatio: number; readonly edge: number };
  readonly regions: readonly RegionQuality[];
  /** Up to ten, worst first, by their angles. */
  readonly worst: readonly ElementQuality[];
  /** By volume. */
  readonly smallest: ElementQuality | null;
  /** Largest by smallest volume. */
  readonly volumeRatio: number;
  /** Of all edges. */
  readonly edges: EdgeStatistics;
  /** Tetrahedra with an angle below 30° or above 135° which the boundary does not excuse. */
  readonly outOfRange: number;
  /** Those it does. */
  readonly limitedByBoundary: LimitedByBoundary;
}
