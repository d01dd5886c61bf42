import type { SurfaceInput } from "tetrafront";
import type { Position } from "./position";
import { boxOf } from "./vectors";

/** Triangles of a surface in the form in which the view draws and hits them. */
export interface DrawnSurface {
  /** Middle of the box around the surface. */
  readonly centre: Position;
  readonly low: Position;
  readonly high: Position;
  /** x y z of three corners per triangle, relative to `centre`; the triangles of a patch follow each other. */
  readonly corners: Float32Array<ArrayBuffer>;
  /** Index in the surface of each drawn triangle. */
  readonly order: Uint32Array<ArrayBuffer>;
  /** Patch p has the drawn triangles from patchOffsets[p] to before patchOffsets[p + 1]. */
  readonly patchOffsets: Uint32Array<ArrayBuffer>;
  /** One value per corner, if the surface has values. */
  readonly values: Float32Array<ArrayBuffer> | null;
  /**
   * Per corner the edges of its triangle within a patch, if they are not drawn: the sum of 1, 2 and 4 for those opposite to the
   * first, second and third corner.
   */
  readonly hiddenEdges?: Float32Array<ArrayBuffer> | undefined;
}

/** Returns the drawn triangles of a surface with `patchCount` patches and one value per triangle, if it has values. */
export function drawnSurface(
  { points, triangles, trianglePatch }: SurfaceInput,
  patchCount: number,
  triangleValues: ArrayLike<number> | null = null,
): DrawnSurface {
  const count = triangles.length / 3;
  const { low, high } = boxOf(points);
  const centre: Position = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
  const patchOf = (triangle: number): number => Math.min(trianglePatch?.[triangle] ?? 0, patchCount - 1);
  const { order, patchOffsets } = sortedByPatch(count, patchCount, patchOf);
  const corners = new Float32Array(9 * count);
  const values = triangleValues && new Float32Array(3 * count);
  for (let drawn = 0; drawn < count; ++drawn) {
    const triangle = order[drawn] ?? 0;
    for (let corner = 0; corner < 3; ++corner) {
      const node = 3 * (triangles[3 * triangle + corner] ?? 0);
      const at = 9 * drawn + 3 * corner;
      corners[at] = (points[node] ?? 0) - centre[0];
      corners[at + 1] = (points[node + 1] ?? 0) - centre[1];
      corners[at + 2] = (points[node + 2] ?? 0) - centre[2];
    }
    values?.fill(triangleValues?.[triangle] ?? 0, 3 * drawn, 3 * drawn + 3);
  }
  return { centre, low, high, corners, order, patchOffsets, values };
}

/** Returns a surface with only the edges between patches to be drawn: the triangles of a solid are not those of a mesh. O(triangles). */
export function withoutInnerEdges(
  drawn: DrawnSurface,
  { triangles, trianglePatch }: Pick<SurfaceInput, "triangles" | "trianglePatch">,
): DrawnSurface {
  const hiddenEdges = new Float32Array(3 * drawn.order.length);
  const nodes = triangles.reduce((highest, node) => Math.max(highest, node), 0) + 1;
  const first = new Map<number, number>();
  const hide = (corner: number): void => {
    const start = corner - (corner % 3);
    const bit = 1 << (corner % 3);
    for (let k = start; k < start + 3; ++k) hiddenEdges[k] = (hiddenEdges[k] ?? 0) + bit;
  };
  drawn.order.forEach((triangle, slot) => {
    for (let corner = 0; corner < 3; ++corner) {
      const [a, b] = [1, 2].map((k) => triangles[3 * triangle + ((corner + k) % 3)] ?? 0) as [number, number];
      const key = Math.min(a, b) * nodes + Math.max(a, b);
      const other = first.get(key);
      if (other === undefined) first.set(key, 3 * slot + corner);
      else if (trianglePatch?.[drawn.order[Math.floor(other / 3)] ?? 0] === trianglePatch?.[triangle]) {
        hide(other);
        hide(3 * slot + corner);
      }
    }
  });
  return { ...drawn, hiddenEdges };
}

/** Counting sort; triangles of one patch keep their order. */
function sortedByPatch(count: number, patchCount: number, patchOf: (triangle: number) => number) {
  const patchOffsets = new Uint32Array(patchCount + 1);
  for (let t = 0; t < count; ++t) patchOffsets[patchOf(t) + 1] = (patchOffsets[patchOf(t) + 1] ?? 0) + 1;
  for (let p = 0; p < patchCount; ++p)
    patchOffsets[p + 1] = (patchOffsets[p + 1] ?? 0) + (patchOffsets[p] ?? 0);
  const next = patchOffsets.slice();
  const order = new Uint32Array(count);
  for (let t = 0; t < count; ++t) {
    const slot = next[patchOf(t)] ?? 0;
    order[slot] = t;
    next[patchOf(t)] = slot + 1;
  }
  return { order, patchOffsets };
}

/** Returns the buffers of a drawn surface, for the transfer list of a message. */
export function buffersOfDrawn({
  corners,
  order,
  patchOffsets,
  values,
  hiddenEdges,
}: DrawnSurface): ArrayBuffer[] {
  const optional = [values, hiddenEdges].filter((array) => array != null);
  return [corners, order, patchOffsets, ...optional].map(({ buffer }) => buffer);
}
