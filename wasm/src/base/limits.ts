/** The bounds of numbers that say how to mesh, as the engine has them (cpp/include/tetrafront/options.h). */
export const LIMITS = {
  /** Sizes and distances, in model units; beyond this neither they nor coordinates can be computed with. */
  length: 1e30,
  /** Growth of the size per unit of distance: no element could follow more. */
  growth: 10,
  /** Growth of the size from one element to the next. */
  gradation: 10,
  /** Length along the direction of stretching divided by the size. */
  stretching: 1e6,
  /** Findings of one code that an inspection lists: at 0.8 kB each, a JavaScript heap holds a few million. */
  maxDiagnostics: 1_000_000,
} as const;
