import type { MesherErrorCode } from "./mesher-error.js";
import type { ReadCode } from "../formats/read-result.js";

/**
 * The stable names of everything a run can complain about. The numbers are those of the engine's
 * `DiagnosticCode` (cpp/include/tetrafront/status.h), which a test compares with this table.
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
  8: "loop-touches-itself",
  9: "not-planar",
  12: "empty-model",
  13: "degenerate-patch",
  14: "hole-outside",
  15: "bad-option",
  16: "line-crosses-itself",
  17: "patches-meet",
  18: "hole-off-patch",
  19: "duplicate-lines",
  20: "empty-background-grid",
  21: "bad-size",
  22: "bad-stretching",
  23: "flat-background-tetrahedron",
  24: "outside-background-grid",
  25: "too-many-elements",
  26: "bad-source",
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
  49: "nested-bodies",
  50: "turned-triangle",
  51: "coarse-surface",
  60: "stalled",
  61: "verification-failed",
} as const;

/** The options that `bad-option` is about, by the engine's numbers. */
export const ENGINE_OPTIONS = ["size", "growth", "gradation"] as const;

/** What the engine finds. */
export type EngineCode = (typeof ENGINE_CODES)[keyof typeof ENGINE_CODES];

/** What the package and its command line find themselves. */
export type PackageCode =
  /** An option is out of range. */
  | "invalid-option"
  /** The arrays of a surface or a mesh do not fit together. */
  | "invalid-arrays"
  /** A mesh whose elements do not fit together. */
  | "unsound-mesh"
  /** A format has no place for something, which is not in the file. */
  | "left-out"
  /** A file could not be opened or written, or holds nothing that a command could use. */
  | "unreadable-input"
  /** The memory did not suffice. */
  | "out-of-memory"
  /** The worker or the engine cannot be had. */
  | "engine-not-loaded"
  /** Our own mistake. */
  | "engine-failed";

/** Everything that can be found in what is given, by its stable name. */
export type DiagnosticCode = EngineCode | PackageCode | ReadCode;

/** Everything that can go wrong at all: the codes of diagnostics, of reading, and of calls that are rejected. */
export type ErrorCode = DiagnosticCode | MesherErrorCode;

/** The name of an engine code; undefined for a number the engine does not use. */
export function engineCodeName(code: number): EngineCode | undefined {
  return (ENGINE_CODES as Readonly<Record<number, EngineCode>>)[code];
}
