/** Messages between a reader of CAD files and its worker. */
import type { CadColor, ModelTriangles } from "./trimmed-model.js";

/** Kinds of CAD files that OpenCascade reads. */
export type CadFormat = "step" | "iges" | "brep";

/** Addresses of the two files of the library `occt-import-js`, for browsers. */
export interface CadLibrary {
  /** Address of `occt-import-js/dist/occt-import-js.js`. */
  readonly script: string;
  /** Address of `occt-import-js/dist/occt-import-js.wasm`. */
  readonly wasm: string;
}

export interface CadRequest {
  /** Triangles, by `occt-import-js`, which is the default; or the true faces, by `replicad-opencascadejs`, which reads no IGES. */
  readonly wants?: "triangles" | "faces";
  readonly format: CadFormat;
  readonly bytes: Uint8Array;
  readonly deflection: Deflection;
  /** Undefined in Node, which finds the library by its name. */
  readonly library: CadLibrary | undefined;
}

/** Largest distance of the triangles from the CAD faces. */
export interface Deflection {
  /** In millimetres, or relative to the mean side of the box around each part of the file. */
  readonly distance: number;
  readonly isRelative: boolean;
  /** Largest angle between the normals at the ends of an edge, in radians. */
  readonly angle: number;
}

export interface CadFace {
  /** Number of its triangles, which follow those of the face before it. */
  readonly triangles: number;
  readonly color: CadColor | undefined;
}

/** Triangles of a solid, or of faces that are not part of a solid. Each face has nodes of its own. */
export interface CadShape {
  /** Empty if the file has none. */
  readonly name: string;
  /** Whether the name is the solid's own, and not that of the assembly above it. */
  readonly hasOwnName: boolean;
  /** x y z per node, in millimetres; BREP files have no unit. */
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  readonly faces: readonly CadFace[];
}

/** Faces as trimmed surfaces, in the numbers of the engine, with triangles near them. */
export interface CadTrueFaces extends ModelTriangles {
  readonly numbers: Float64Array;
}

/** How a worker ends by itself; `failed` if its cause is the file. */
export interface CadCrash {
  readonly kind: "failed" | "not-loaded" | "out-of-memory";
  readonly message: string;
}

/** The worker was terminated because reading the file, or loading the library, took longer than the limit. */
export interface CadTimeout {
  readonly kind: "timed-out" | "loading-timed-out";
  readonly seconds: number;
}

export type CadReply =
  | { readonly kind: "read"; readonly shapes: readonly CadShape[] }
  | { readonly kind: "faces"; readonly faces: CadTrueFaces }
  /** OpenCascade rejects the file. */
  | { readonly kind: "rejected" }
  /** OpenCascade failed in the file, its memory is exhausted, or the worker or the library could not be loaded. */
  | CadCrash
  | CadTimeout;

/** Sent before the reply, when the library has been loaded and begins to read. */
export interface CadLoaded {
  readonly kind: "loaded";
}
