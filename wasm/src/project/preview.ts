/** Preview of a project. */
import type { Diagnostic } from "../diagnostics/diagnostic.js";

/** Samples of a project for display, and its diagnostics. */
export interface ProjectPreview {
  /** Polyline of line l: linePoints[3i..3i+2], lineOffsets[l] <= i < lineOffsets[l+1]. */
  readonly linePoints: Float64Array;
  readonly lineOffsets: Uint32Array;
  /** Triangles of patch p: patchTriangles[3t..3t+2], patchOffsets[p] <= t < patchOffsets[p+1]. */
  readonly patchPoints: Float64Array;
  readonly patchTriangles: Uint32Array;
  readonly patchOffsets: Uint32Array;
  readonly diagnostics: readonly Diagnostic[];
}
