import type { BufferGeometry } from "three";
import type { MeshBVH, MeshBVHOptions } from "three-mesh-bvh";

let Tree: typeof MeshBVH | null = null;

/** Fetches what search trees are made with: not needed for the first picture. */
export async function loadSearchTrees(): Promise<void> {
  Tree = (await import("./mesh-bvh")).MeshBVH;
}

/** A search tree over triangles; null until the library is there. */
export function createSearchTree(geometry: BufferGeometry, options: MeshBVHOptions): MeshBVH | null {
  return Tree ? new Tree(geometry, options) : null;
}
