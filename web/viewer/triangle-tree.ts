import { BackSide, DoubleSide, Vector3, type Ray, type Side } from "three";
import { nextTurn } from "../document/slices";
import type { RayHit, SerializedTree } from "./triangle-boxes";

export type { RayHit as TriangleHit, SerializedTree };

/** All triangles of a smaller surface are tried in about a millisecond: a tree would not pay, and its library need not be loaded. */
const MIN_TRIANGLES = 20_000;

/** Finds triangles on a ray, in a large surface by a tree of boxes. */
export class TriangleTree {
  readonly #corners: Float32Array;
  /** Lists the triangles on a ray. */
  #search: (ray: Ray, side: Side) => Iterable<RayHit>;

  /** @param corners x y z of three corners per triangle, which must not change later. */
  constructor(corners: Float32Array) {
    this.#corners = corners;
    this.#search = (ray, side) => hitsOf(corners, ray, side);
  }

  /** Lets a worker build the tree of a large surface. A search that comes first, or after a failure, tries all triangles. */
  async prepare(build: (corners: Float32Array<ArrayBuffer>) => Promise<SerializedTree>): Promise<void> {
    if (this.#corners.length < 9 * MIN_TRIANGLES) return;
    // The copy of a large surface takes long enough to be a task of its own.
    await nextTurn();
    try {
      const [{ searchIn }, tree] = await Promise.all([
        import("./triangle-boxes"),
        build(this.#corners.slice()),
      ]);
      this.#search = searchIn(tree, this.#corners);
    } catch {
      // The worker has been stopped or is out of memory, which its other calls report.
    }
  }

  /** Returns the first triangle on the ray that is accepted, seen from the given side; null if there is none. */
  firstHit(ray: Ray, side: Side, accepts: (triangle: number) => boolean = () => true): RayHit | null {
    let nearest: RayHit | null = null;
    for (const hit of this.#search(ray, side))
      if ((!nearest || hit.distance < nearest.distance) && accepts(hit.triangle)) nearest = hit;
    return nearest;
  }
}

/** Tries all triangles. */
function* hitsOf(corners: Float32Array, ray: Ray, side: Side): Generator<RayHit> {
  const [a, b, c, point] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  const [first, last] = side === BackSide ? [c, a] : [a, c];
  for (let at = 0; at < corners.length; at += 9) {
    a.fromArray(corners, at);
    b.fromArray(corners, at + 3);
    c.fromArray(corners, at + 6);
    if (ray.intersectTriangle(first, b, last, side !== DoubleSide, point) === null) continue;
    yield { triangle: at / 9, distance: ray.origin.distanceTo(point), point: [point.x, point.y, point.z] };
  }
}
