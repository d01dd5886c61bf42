/** Messages between a reader of CAD files and its worker. */
import type { CadColor, ModelTriangles } from "./trimmed-model.js";

/** Kinds of CAD files that OpenCascade reads. */
export type CadFormat = "step" | "iges" | "brep";

/** Addresses of the libraries that read CAD files, for browsers. */
export interface CadLibrary {
  /** Address of `occt-import-js/dist/occt-import-js.js`, which reads IGES. */
  readonly script: string;
  /** Address of `occt-import-js/dist/occt-import-js.wasm`. */
  readonly wasm: string;
  /**
   * Addresses of `replicad-opencascadejs/dist/replicad_single.js` and `.wasm`, which read STEP and BREP with their true faces. Without
   * them, `occt-import-js` reads the triangles of such files.
   */
  readonly kernel?: { readonly script: string; readonly wasm: string } | undefined;
}

export interface CadRequest {
  readonly format: CadFormat;
  readonly bytes: Uint8Array;
  readonly deflection: Deflection;
  /** Whether solids that touch get common faces: the kernel's general fuse. */
  readonly sharesFaces: boolean;
  /** Whether the reply has the shape without triangles, so that it can be triangulated more finely. */
  readonly keepsBare?: boolean | undefined;
  /** That shape, if the file was read before; the bytes are only needed for names and colours. */
  readonly bare?: FileTexts | undefined;
  /** Node finds the libraries by their names. */
  readonly library: CadLibrary;
}

/** The shape of a file as the texts of BREP files. */
export interface FileTexts {
  /** Perhaps with triangles within a distance of its faces. Solids that touch share what they have in common. */
  readonly text: string;
  /** If solids share something: the shape as it is in the file, and per solid and face the given face of which it is a part. */
  readonly given?: { readonly text: string; readonly origins: readonly (readonly number[])[] } | undefined;
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
  /** Undefined or empty if the file has none. */
  readonly name?: string | undefined;
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
  /** Undefined if the library hands out triangles only. */
  readonly trueFaces?: CadTrueFaces | undefined;
}

/** The faces of a solid as trimmed surfaces, in the numbers of the engine, with triangles near them. */
export interface CadTrueFaces extends ModelTriangles {
  readonly numbers: Float64Array;
  readonly faceCount: number;
  /** How many faces are missing, and why: a sentence for each cause. */
  readonly missing: readonly string[];
}

/** How a worker ends by itself; `failed` if its cause is the file, `ended` if another program ended it. */
export interface CadCrash {
  readonly kind: "failed" | "ended" | "not-loaded" | "out-of-memory";
  readonly message: string;
}

/** The worker was terminated because reading the file, or loading the library, took longer than the limit. */
export interface CadTimeout {
  readonly kind: "timed-out" | "loading-timed-out";
  readonly seconds: number;
}

export type CadReply =
  | {
      readonly kind: "read";
      readonly shapes: readonly CadShape[];
      readonly bare?: FileTexts | undefined;
      /** Whether the search for common faces was given up. */
      readonly areApart?: true;
    }
  /** OpenCascade rejects the file. */
  | { readonly kind: "rejected" }
  /** OpenCascade failed in the file, its memory is exhausted, it was ended, or the worker or the library could not be loaded. */
  | CadCrash
  | CadTimeout;

/** Sent before the reply: the library has been loaded and begins to read, or it begins to search for faces that solids share. */
export type CadProgress = { readonly kind: "loaded" } | { readonly kind: "sharing" };
