import { ENGINE_CODES, type EngineCode } from "../generated/constants.js";
import type { ReadCode } from "./read-error.js";

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
  /** The digits of the coordinates are few for the triangles, which are far from the origin. */
  | "coarse-coordinates"
  /** A remeshed surface may be farther from the given one than the tolerance. */
  | "deviation-above-tolerance"
  /** A remeshed surface encloses another volume than the given one. */
  | "changed-volume"
  /** A body is so thin that one layer of good elements takes very many. */
  | "thin-body"
  /** Two solids of a file overlap, or touch in faces with different boundaries. */
  | "touching-solids"
  /** Bodies of a surface intersected, and a repair made them one. */
  | "joined-bodies"
  /** Open boundaries of a surface face each other across a gap. */
  | "cracked-surface"
  /** Faces of a CAD file do not fit together, and the surface was repaired there. */
  | "damaged-faces"
  /** Nodes of open edges of a surface nearly coincide. */
  | "near-nodes"
  /** Triangles of a surface were far larger than the sizes, and were split or replaced. */
  | "divided-surface"
  /** Too many triangles of a surface were needles, and all were replaced. */
  | "replaced-surface"
  /** A mesh does not have the number of elements that was asked for. */
  | "element-count"
  /** A field of a solution is linear, so no sizes follow from it. */
  | "constant-field"
  /** A surface was valid, but is not after the rounding of its file format. */
  | "invalid-when-rounded"
  /** Many elements of a mesh have small dihedral angles. */
  | "poor-elements"
  /** The mesh has a dihedral angle below the one that the command line requires. */
  | "required-angle"
  /** Elements of a mesh had negative volume and were oriented. */
  | "inverted-tetrahedra"
  /** Thorough optimization found no better mesh than the default, or an improvement none better than the given one. */
  | "no-improvement"
  /** An improvement might make poor elements better if it might add more elements. */
  | "growth-limited"
  /** A format cannot store some content, which is not in the file. */
  | "left-out"
  /** A point that marks a region or a hole has no effect, or does not decide what it marks. */
  | "region-point"
  /** The points that mark the regions and holes of a surface have not been located. */
  | "unlocated-regions"
  /** The solver of an adaptation failed, or wrote no solution. */
  | "solver-failed"
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
