/** Result of `addLayers`: a mesh with layers of stretched elements along patches. */
import type { MeshAdaptation } from "./adaptation.js";

/** The layers of one patch. Layer k, counted from 0 at the patch, is `firstHeight` · `growth`^k high. */
export interface PatchLayers {
  /** Name of the patch; all patches with this name get layers. */
  readonly patch: string;
  /** Height of the first layer, above 0. */
  readonly firstHeight: number;
  /** Height of a layer / height of the one below, 1 to 10. Default 1.2. */
  readonly growth?: number | undefined;
  /** Number of layers, 1 to 1000. Default 10. */
  readonly count?: number | undefined;
}

/** What was made along one patch. */
export interface LayersMade {
  /** Name of the patch. */
  readonly patch: string;
  /** Number of triangles of the patch. */
  readonly triangles: number;
  /** Mean height of the elements above these triangles. */
  readonly meanFirstHeight: number;
  /** Thickness of all layers that were asked for. */
  readonly thickness: number;
}

/** Result of `addLayers`. `before` belongs to the given mesh, `after` to the last one and its metric. */
export interface LayeredMesh extends MeshAdaptation {
  readonly layers: readonly LayersMade[];
  /** Number of adaptations. */
  readonly cycles: number;
  /** Largest ratio of two axes of the ellipsoid through the corners of an element. */
  readonly largestAspect: number;
}
