/**
 * Welding within a tolerance. In their order, points become the first kept point that is no further away
 * than the tolerance, or are kept: no chain of near points moves one by more than the tolerance, and the
 * result depends on nothing but the file. The kept points are found in a grid of cells as wide as the
 * tolerance; as any two of them are further apart, a cell holds a few at most, so that the cost is O(n).
 *
 * The engine's weldedNodes (cpp/src/surface/weld.h) follows the same rule for `repairSurface`, which lists
 * every change and sorts to do so. Reading is a plain function that loads no engine, and so has its own.
 */
import { ReadFailure } from "../read-result.js";

export interface PatchedTriangles {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  readonly trianglePatch: Uint32Array;
}

export interface WeldedWithin extends PatchedTriangles {
  readonly welded: { readonly points: number; readonly triangles: number };
}

/** A cell's number must be exact; beyond this many cells per axis rounding decides. */
const MOST_CELLS = 2 ** 40;
const NONE = 0xffffffff;

/** Throws a ReadFailure where the tolerance is lost in the rounding of the coordinates. */
export function weldWithin(mesh: PatchedTriangles, tolerance: number): WeldedWithin {
  const { positions, kept } = positionsWithin(mesh.points, tolerance);
  const points = new Float64Array(3 * kept.length);
  kept.forEach((node, i) => points.set(mesh.points.subarray(3 * node, 3 * node + 3), 3 * i));
  const triangles = new Uint32Array(mesh.triangles.length);
  const trianglePatch = new Uint32Array(mesh.trianglePatch.length);
  let count = 0;
  for (let t = 0; t < trianglePatch.length; t++) {
    const [a, b, c] = [0, 1, 2].map((i) => positions[mesh.triangles[3 * t + i] ?? 0] ?? 0);
    if (a === undefined || b === undefined || c === undefined || a === b || b === c || c === a) continue;
    triangles.set([a, b, c], 3 * count);
    trianglePatch[count++] = mesh.trianglePatch[t] ?? 0;
  }
  return {
    points,
    triangles: triangles.slice(0, 3 * count),
    trianglePatch: trianglePatch.slice(0, count),
    welded: {
      points: mesh.points.length / 3 - kept.length,
      triangles: mesh.trianglePatch.length - count,
    },
  };
}

interface Positions {
  /** Per point: which of the kept ones it is. */
  readonly positions: Uint32Array;
  readonly kept: readonly number[];
}

function positionsWithin(points: Float64Array, tolerance: number): Positions {
  const count = points.length / 3;
  const cells = cellsOf(points, tolerance);
  const grid = new CellGrid(count);
  const positions = new Uint32Array(count);
  const kept: number[] = [];
  for (let node = 0; node < count; node++) {
    const near = firstNear(node);
    if (near !== NONE) {
      positions[node] = near;
      continue;
    }
    positions[node] = kept.length;
    grid.add(cells, node, kept.length);
    kept.push(node);
  }
  return { positions, kept };

  function firstNear(node: number): number {
    let first = NONE;
    const [x, y, z] = [cells[3 * node] ?? 0, cells[3 * node + 1] ?? 0, cells[3 * node + 2] ?? 0];
    for (let i = -1; i <= 1; i++) {
      for (let j = -1; j <= 1; j++) {
        for (let k = -1; k <= 1; k++) {
          for (let at = grid.first(x + i, y + j, z + k); at !== NONE; at = grid.next(at)) {
            if (at < first && isNear(node, kept[at] ?? 0)) first = at;
          }
        }
      }
    }
    return first;
  }

  function isNear(a: number, b: number): boolean {
    const dx = (points[3 * a] ?? 0) - (points[3 * b] ?? 0);
    const dy = (points[3 * a + 1] ?? 0) - (points[3 * b + 1] ?? 0);
    const dz = (points[3 * a + 2] ?? 0) - (points[3 * b + 2] ?? 0);
    return dx * dx + dy * dy + dz * dz <= tolerance * tolerance;
  }
}

/** Per point the whole numbers x y z of its cell, from the lowest corner of all. */
function cellsOf(points: Float64Array, tolerance: number): Float64Array {
  const low = [Infinity, Infinity, Infinity];
  points.forEach((value, i) => (low[i % 3] = Math.min(low[i % 3] ?? Infinity, value)));
  return points.map((value, i) => {
    const cell = Math.floor((value - (low[i % 3] ?? 0)) / tolerance);
    if (cell < MOST_CELLS) return cell;
    throw new ReadFailure({
      message: `the weld tolerance ${tolerance} is lost in the rounding of coordinates like ${value}`,
      remedy: "Give a larger weld tolerance, or none: equal points are welded anyway.",
    });
  });
}

/** The kept points by their cell: chains in a hash table. Those of other cells may be in a chain too. */
class CellGrid {
  readonly #heads: Uint32Array;
  readonly #next: Uint32Array;

  constructor(points: number) {
    let size = 16;
    while (size < points) size *= 2;
    this.#heads = new Uint32Array(size).fill(NONE);
    this.#next = new Uint32Array(points);
  }

  add(cells: Float64Array, node: number, position: number): void {
    const slot = this.#slot(cells[3 * node] ?? 0, cells[3 * node + 1] ?? 0, cells[3 * node + 2] ?? 0);
    this.#next[position] = this.#heads[slot] ?? NONE;
    this.#heads[slot] = position;
  }

  first(x: number, y: number, z: number): number {
    return this.#heads[this.#slot(x, y, z)] ?? NONE;
  }

  next(position: number): number {
    return this.#next[position] ?? NONE;
  }

  #slot(x: number, y: number, z: number): number {
    let h = 0;
    for (const cell of [x, y, z]) {
      // Low and high bits: a cell's number has up to 41.
      h = Math.imul(h ^ (cell | 0) ^ Math.floor(cell / 2 ** 20), 0x9e3779b1);
      h ^= h >>> 15;
    }
    return (h >>> 0) & (this.#heads.length - 1);
  }
}
