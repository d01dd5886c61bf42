import type { Histogram, QualityMeasure, QualitySpace } from "../../document/mesh-quality";
import type { Position } from "../../document/position";
import type { Cut } from "../../document/selection";
import type { QueriedMesh, ViewOptions } from "./mesh-queries";
import type { DrawnFaces, FieldValues } from "./visible-faces";
import type { SerializedTree } from "../triangle-boxes";

/** In pixels. */
export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/** The calls that the mesh query worker answers, in order unless it loads code for one first. */
export interface MeshQueryProtocol {
  /** Sets the mesh that all later queries are about; null for none. */
  readonly setMesh: { readonly argument: QueriedMesh | null; readonly answer: null };
  /** Sets the values at the nodes of the mesh that colours can show. */
  readonly setField: { readonly argument: FieldValues; readonly answer: null };
  /** Where these values have a level: x y z of three corners per triangle, relative to `origin`. */
  readonly isosurface: {
    readonly argument: { readonly level: number; readonly origin: Position };
    readonly answer: Float32Array<ArrayBuffer>;
  };
  readonly faces: { readonly argument: ViewOptions; readonly answer: DrawnFaces };
  readonly histogram: {
    readonly argument: {
      readonly measure: QualityMeasure;
      readonly space: QualitySpace;
      readonly barCount: number;
    };
    readonly answer: Histogram;
  };
  /** The cut that exposes an element to a viewer in a direction. */
  readonly cut: {
    readonly argument: { readonly element: number; readonly toEye: Position };
    readonly answer: Cut;
  };
  /** A small picture of the middle of a large one, which the page would have to wait for. */
  readonly picture: {
    readonly argument: { readonly view: ImageBitmap; readonly size: PictureSize };
    readonly answer: Blob;
  };
  /** For hit tests: x y z of three corners per triangle, of the mesh or of anything else. */
  readonly tree: { readonly argument: Float32Array<ArrayBuffer>; readonly answer: SerializedTree };
}
