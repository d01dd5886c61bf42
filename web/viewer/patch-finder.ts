import type { SurfaceMesh } from "tetrafront";

/** Finds the patch that a boundary face belongs to, from its three nodes in any order. */
export class PatchFinder {
  readonly #surface: SurfaceMesh;
  /** Triangles by their lowest node: first triangle, and next triangle of the same lowest node. */
  readonly #first = new Map<number, number>();
  readonly #next: Int32Array;

  constructor(surface: SurfaceMesh) {
    this.#surface = surface;
    const count = surface.triangles.length / 3;
    this.#next = new Int32Array(count);
    for (let t = 0; t < count; ++t) {
      const [a, b, c] = this.#nodes(t);
      const low = Math.min(a, b, c);
      this.#next[t] = this.#first.get(low) ?? -1;
      this.#first.set(low, t);
    }
  }

  /** Position of the patch in the project, or null if no boundary triangle has these nodes. */
  find(nodes: readonly number[]): number | null {
    const wanted = new Set(nodes);
    let t = this.#first.get(Math.min(...nodes)) ?? -1;
    while (t >= 0) {
      if (this.#nodes(t).every((node) => wanted.has(node))) return this.#surface.trianglePatch[t] ?? null;
      t = this.#next[t] ?? -1;
    }
    return null;
  }

  #nodes(triangle: number): [number, number, number] {
    const { triangles } = this.#surface;
    const at = 3 * triangle;
    return [triangles[at] ?? 0, triangles[at + 1] ?? 0, triangles[at + 2] ?? 0];
  }
}
