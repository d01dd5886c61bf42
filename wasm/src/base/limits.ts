import { MAX_GRADATION, MAX_GROWTH, MAX_LENGTH, MAX_STRETCHING } from "../generated/constants.js";

/** Returns the text of a limit for messages: 1e30, where JavaScript writes 1e+30. */
export const limitText = (limit: number): string => String(limit).replace("+", "");

/**
 * Height of steps between faces that nearly coincide / diagonal, up to which they are removed by the repair before a
 * remeshing: a sixteenth of the default tolerance of a remeshing.
 */
export const STEP_HEIGHT = 1 / 4096;

/** Most threads that optimize a mesh by default: beyond, what one thread must do alone takes most of the time. */
export const DEFAULT_THREADS = 8;

/** Largest values of numeric options, and the largest length of an expression. */
export const LIMITS = {
  /**
   * Sizes and distances, in model units; the engine cannot compute with larger ones, nor with larger coordinates.
   */
  length: MAX_LENGTH,
  /** Growth of the size per unit of distance; elements cannot follow a larger one. */
  growth: MAX_GROWTH,
  /** Number of elements that an improvement may add, as a fraction of the given ones. */
  elementGrowth: 100,
  /** Ratio of the sizes of neighbouring elements. */
  gradation: MAX_GRADATION,
  /** Size along the direction of stretching / size across it. */
  stretching: MAX_STRETCHING,
  /**
   * Number of diagnostics that an inspection lists per code; at 0.8 kB each, a JavaScript heap holds a few
   * million.
   */
  maxDiagnostics: 1_000_000,
  /** Number of tetrahedra of a run; the memory of the engine, 4 GB, is usually less. Their edges are counted in 32 bits. */
  tetrahedra: 500_000_000,
  /** Number of threads that optimize a mesh. */
  threads: 64,
  /** Number of characters of an expression in a project. */
  expression: 1000,
} as const;
