/** Triangles whose patches are known. */
export interface PatchArrays {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  readonly trianglePatch: Uint32Array;
}
