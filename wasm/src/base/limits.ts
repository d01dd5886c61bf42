/** Limits of numeric options, as in the engine (cpp/include/tetrafront/options.h). */
export const LIMITS = {
  /**
   * Sizes and distances, in model units; the engine cannot compute with larger ones, nor with larger coordinates.
   */
  length: 1e30,
  /** Growth of the size per unit of distance; elements cannot follow a larger one. */
  growth: 10,
  /** Ratio of the sizes of neighbouring elements. */
  gradation: 10,
  /** Size along the direction of stretching / size across it. */
  stretching: 1e6,
  /**
   * Number of diagnostics that an inspection lists per code; at 0.8 kB each, a JavaScript heap holds a few
   * million.
   */
  maxDiagnostics: 1_000_000,
} as const;
