import type { Histogram, QualityMeasure, QualitySpace } from "../../document/mesh-quality";
import type { DrawnFaces, QueriedMesh, ViewOptions } from "./mesh-queries";
import type { SerializedTree } from "../triangle-tree";

/** The calls that the mesh query worker answers, all but `tree` in order. */
export interface MeshQueryProtocol {
  /** Sets the mesh that all later queries are about; null for none. */
  readonly setMesh: { readonly argument: QueriedMesh | null; readonly answer: null };
  readonly faces: { readonly argument: ViewOptions; readonly answer: DrawnFaces };
  readonly histogram: {
    readonly argument: {
      readonly measure: QualityMeasure;
      readonly space: QualitySpace;
      readonly barCount: number;
    };
    readonly answer: Histogram;
  };
  /** For hit tests: x y z of three corners per triangle, of the mesh or of anything else. */
  readonly tree: { readonly argument: Float32Array<ArrayBuffer>; readonly answer: SerializedTree };
}
