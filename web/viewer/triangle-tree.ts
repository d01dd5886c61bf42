import { BufferAttribute, BufferGeometry, type Ray, type Side } from "three";
import { MeshBVH } from "three-mesh-bvh";

export interface TriangleHit {
  /** Index of the triangle. */
  readonly triangle: number;
  readonly distance: number;
  /** Local x y z. */
  readonly point: readonly [number, number, number];
}

/**
 * Finds triangles on a ray by a tree of boxes. The tree is built by the first search, in about 0.6 ms per
 * 1000 triangles; each search then takes microseconds.
 */
export class TriangleTree {
  readonly #corners: Float32Array;
  #tree: MeshBVH | null = null;

  /** @param corners x y z of three corners per triangle, which must not change later. */
  constructor(corners: Float32Array) {
    this.#corners = corners;
  }

  /** Returns the first triangle on the ray that is accepted, seen from the given side; null if there is none. */
  firstHit(ray: Ray, side: Side, accepts: (triangle: number) => boolean = () => true): TriangleHit | null {
    if (this.#corners.length === 0) return null;
    let nearest: TriangleHit | null = null;
    for (const { faceIndex, distance, point } of this.#built().raycast(ray, side)) {
      if (typeof faceIndex !== "number" || (nearest && nearest.distance <= distance)) continue;
      if (!accepts(faceIndex)) continue;
      nearest = { triangle: faceIndex, distance, point: [point.x, point.y, point.z] };
    }
    return nearest;
  }

  #built(): MeshBVH {
    const position = new BufferAttribute(this.#corners, 3);
    // Indirect: the order of the triangles stays.
    this.#tree ??= new MeshBVH(new BufferGeometry().setAttribute("position", position), { indirect: true });
    return this.#tree;
  }
}
