import type { Position } from "./position";
import { forEachInSlices } from "./slices";

/** Nodes, x y z each, and triangles, three nodes each. */
export interface Triangles {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
}

/** Lowest and highest coordinates. */
export interface Box {
  readonly low: Position;
  readonly high: Position;
}

/** What the division of triangles into pieces needs to know about them. */
export interface Facts {
  readonly surface: Triangles;
  /** Length of the longest edge of each triangle. */
  readonly longestEdges: Float64Array;
  readonly longestOfAll: number;
  /** Number of nodes that triangles use. */
  readonly usedNodes: number;
  /** The box around the nodes; null without any. */
  readonly box: Box | null;
}

/** A measurement that is done or under way, and the triangles that it is of. */
interface Measurement {
  readonly triangles: Uint32Array;
  readonly facts: Promise<Facts>;
}

/** The measurements of surfaces, by their nodes: a body keeps its arrays until it is prepared again. */
const known = new WeakMap<Float64Array, Measurement>();

/**
 * Measures a surface in slices; the same arrays only once, also if they are asked for again before the end. It cannot be
 * cancelled, because the next question needs the same facts. O(nodes + triangles).
 */
export function factsOf(surface: Triangles): Promise<Facts> {
  const { points, triangles } = surface;
  const before = known.get(points);
  if (before?.triangles === triangles) return before.facts;
  const facts = measured(surface);
  known.set(points, { triangles, facts });
  return facts;
}

async function measured(surface: Triangles): Promise<Facts> {
  const { points, triangles } = surface;
  const longestEdges = new Float64Array(Math.floor(triangles.length / 3));
  const isUsed = new Uint8Array(points.length / 3);
  let [longestOfAll, usedNodes] = [0, 0];
  const use = (node: number): void => {
    usedNodes += 1 - (isUsed[node] ?? 1);
    isUsed[node] = 1;
  };
  const edge = (a: number, b: number): number => {
    const x = (points[3 * a] ?? 0) - (points[3 * b] ?? 0);
    const y = (points[3 * a + 1] ?? 0) - (points[3 * b + 1] ?? 0);
    const z = (points[3 * a + 2] ?? 0) - (points[3 * b + 2] ?? 0);
    return Math.hypot(x, y, z);
  };
  await forEachInSlices(longestEdges.length, (t) => {
    const [a, b, c] = [triangles[3 * t] ?? 0, triangles[3 * t + 1] ?? 0, triangles[3 * t + 2] ?? 0];
    const length = Math.max(edge(a, b), edge(b, c), edge(c, a));
    longestEdges[t] = length;
    if (length > longestOfAll) longestOfAll = length;
    use(a);
    use(b);
    use(c);
  });
  return { surface, longestEdges, longestOfAll, usedNodes, box: await boxAround(points) };
}

async function boxAround(points: Float64Array): Promise<Box | null> {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  await forEachInSlices(points.length / 3, (node) => {
    for (let axis = 0; axis < 3; ++axis) {
      const x = points[3 * node + axis] ?? 0;
      if (x < (low[axis] ?? 0)) low[axis] = x;
      if (x > (high[axis] ?? 0)) high[axis] = x;
    }
  });
  return points.length > 0 ? { low, high } : null;
}

/** Largest number of pieces of an edge. */
const maxPieces = 64;

/** Returns into how many pieces an edge is divided so that none is longer than `longest`. */
export const piecesOf = (length: number, longest: number): number =>
  Math.min(maxPieces, Math.max(1, Math.ceil(length / longest) || 1));
