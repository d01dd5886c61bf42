import { BufferAttribute, BufferGeometry, type Ray, type Side } from "three";
import { nextTurn } from "../document/slices";
import { MeshBVH, type SerializedBVH } from "three-mesh-bvh";

export interface TriangleHit {
  /** Index of the triangle. */
  readonly triangle: number;
  readonly distance: number;
  /** Local x y z. */
  readonly point: readonly [number, number, number];
}

/** A tree of boxes around triangles, as a worker sends it. */
export type SerializedTree = SerializedBVH;

/** Builds a tree over triangles given as x y z of three corners each. Takes about 0.6 ms per 1000 triangles. */
export function buildTree(corners: Float32Array): SerializedTree {
  return MeshBVH.serialize(createTree(corners), { cloneBuffers: false });
}

/** Finds triangles on a ray by a tree of boxes, in microseconds. */
export class TriangleTree {
  readonly #corners: Float32Array;
  #tree: MeshBVH | null = null;

  /** @param corners x y z of three corners per triangle, which must not change later. */
  constructor(corners: Float32Array) {
    this.#corners = corners;
  }

  /** Lets a worker build the tree. A search that comes first, or after a failure, builds it at once. */
  async prepare(build: (corners: Float32Array<ArrayBuffer>) => Promise<SerializedTree>): Promise<void> {
    if (this.#corners.length === 0) return;
    // The copy of a large surface takes long enough to be a task of its own.
    await nextTurn();
    try {
      const tree = await build(this.#corners.slice());
      this.#tree ??= MeshBVH.deserialize(tree, geometryOf(this.#corners), { setIndex: false });
    } catch {
      // The worker has been stopped or is out of memory, which its other calls report.
    }
  }

  /** Returns the first triangle on the ray that is accepted, seen from the given side; null if there is none. */
  firstHit(ray: Ray, side: Side, accepts: (triangle: number) => boolean = () => true): TriangleHit | null {
    if (this.#corners.length === 0) return null;
    this.#tree ??= createTree(this.#corners);
    let nearest: TriangleHit | null = null;
    for (const { faceIndex, distance, point } of this.#tree.raycast(ray, side)) {
      if (typeof faceIndex !== "number" || (nearest && nearest.distance <= distance)) continue;
      if (!accepts(faceIndex)) continue;
      nearest = { triangle: faceIndex, distance, point: [point.x, point.y, point.z] };
    }
    return nearest;
  }
}

/** Indirect: the order of the triangles stays. */
function createTree(corners: Float32Array): MeshBVH {
  return new MeshBVH(geometryOf(corners), { indirect: true });
}

function geometryOf(corners: Float32Array): BufferGeometry {
  return new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3));
}
