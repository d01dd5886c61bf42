import type { ReadCode } from "./read-error.js";

/**
 * Stable names of all problems that the engine reports. The numbers are those of the engine's `DiagnosticCode`
 * (cpp/include/tetrafront/status.h).
 */
export const ENGINE_CODES = {
  0: "not-finite",
  1: "index-out-of-range",
  2: "wrong-point-count",
  3: "coincident-points",
  4: "zero-length-line",
  5: "wrong-line-count",
  6: "wrong-line-type",
  7: "loop-not-closed",
  8: "loops-intersect",
  9: "not-planar",
  12: "empty-model",
  13: "degenerate-patch",
  14: "hole-outside",
  15: "option-out-of-range",
  16: "line-self-intersection",
  17: "patches-intersect",
  18: "hole-off-patch",
  19: "duplicate-lines",
  20: "empty-background-grid",
  21: "size-out-of-range",
  22: "stretching-out-of-range",
  23: "degenerate-background-tetrahedron",
  24: "outside-background-grid",
  25: "too-many-elements",
  26: "source-out-of-range",
  27: "duplicate-points",
  28: "size-too-large",
  40: "open-edge",
  41: "dangling-sheet",
  42: "inconsistent-orientation",
  43: "self-intersection",
  44: "duplicate-triangle",
  45: "degenerate-triangle",
  46: "zero-volume",
  47: "reoriented-patch",
  48: "coincident-nodes",
  49: "nested-regions",
  50: "flipped-triangle",
  51: "coarse-surface",
  60: "stalled",
  61: "verification-failed",
} as const;

/** Options that `option-out-of-range` is about, by the engine's numbers. */
export const ENGINE_OPTIONS = ["size", "growth", "gradation"] as const;

/** Code of a diagnostic of the engine. */
export type EngineCode = (typeof ENGINE_CODES)[keyof typeof ENGINE_CODES];

/** Code of a diagnostic of the package or its command line. */
export type PackageCode =
  /** An option is invalid. */
  | "invalid-option"
  /** The arrays of a surface or a mesh are inconsistent. */
  | "invalid-arrays"
  /** The elements of a mesh do not fit together. */
  | "invalid-mesh"
  /** Many triangles of a surface are needles or caps. */
  | "needle-surface"
  /** Many elements of a mesh have small dihedral angles. */
  | "poor-elements"
  /** Thorough optimization found no better mesh than the default. */
  | "no-improvement"
  /** A format cannot store some content, which is not in the file. */
  | "left-out"
  /** A file could not be opened or written, or has no content that a command can use. */
  | "unreadable-input"
  /** The engine ran out of memory. */
  | "out-of-memory"
  /** The worker or the engine could not be loaded. */
  | "engine-not-loaded"
  /** A bug in Tetrafront. */
  | "engine-failed";

/** Code of every diagnostic. */
export type DiagnosticCode = EngineCode | PackageCode | ReadCode;

/** Returns the name of an engine code; undefined for a number that the engine does not use. */
export function engineCodeName(code: number): EngineCode | undefined {
  return (ENGINE_CODES as Readonly<Record<number, EngineCode>>)[code];
}
