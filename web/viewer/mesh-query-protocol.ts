import type { Histogram, QualityMeasure } from "../document/mesh-quality";
import type { DrawnFaces, QueriedMesh, ViewOptions } from "./mesh-queries";

/** The calls that the mesh query worker answers, in order. */
export interface MeshQueryProtocol {
  /** Sets the mesh that all later queries are about; null for none. */
  readonly setMesh: { readonly argument: QueriedMesh | null; readonly answer: null };
  readonly faces: { readonly argument: ViewOptions; readonly answer: DrawnFaces };
  readonly histogram: {
    readonly argument: { readonly measure: QualityMeasure; readonly barCount: number };
    readonly answer: Histogram;
  };
}
