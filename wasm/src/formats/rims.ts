/** The faces of solids and the curves between them, found in triangles that were made face by face. */
import { PAUSE, type Steps, stepwise } from "../base/steps.js";
import { type Corners, cornersOf, dot, lengthOf, minus, pointOf, type Vector } from "../base/vectors.js";
import { type FittedSurface, fittedSurface } from "./fitted-surface.js";
import type { JoinedShapes } from "./joined-shapes.js";

/** Curve between two faces of a shape, as the nodes along it. */
export interface Rim {
  readonly shape: number;
  /** Numbers of the faces to the left and to the right, as seen from outside. */
  readonly faces: readonly [left: number, right: number];
  /** The first one again at the end, if the curve is closed. */
  nodes: readonly number[];
}

/** A face of a shape: a range of triangles. */
export interface ShapeRange {
  readonly shape: number;
  readonly begin: number;
  readonly end: number;
  /** Numbers of its rims. */
  readonly rims: number[];
  /** Undefined if it is none of those that can be fitted. */
  readonly surface: FittedSurface | undefined;
  readonly low: Vector;
  readonly high: Vector;
}

export interface FacesAndRims {
  readonly faces: readonly ShapeRange[];
  readonly rims: readonly Rim[];
}

/** Cosine of the angle by which a curve turns at a corner, although the faces on both sides go on. */
const CORNER = 0.87;

/** Larger than the number of nodes. */
const STRIDE = 2 ** 26;

/** Key of a pair of nodes, in either order. */
export const pairKey = (a: number, b: number): number => (a < b ? a * STRIDE + b : b * STRIDE + a);
/** Key of a pair of nodes in this order. */
export const directedKey = (a: number, b: number): number => a * STRIDE + b;

/**
 * Returns the faces of all shapes and the curves between them. Shapes with an edge that does not have one triangle on each side
 * have none. `tolerance`: of the surfaces.
 */
export function* facesAndRims(joined: JoinedShapes, tolerance: number): Steps<FacesAndRims> {
  const faces: ShapeRange[] = [];
  const rims: Rim[] = [];
  const { shapeOf, faceOf } = joined;
  for (let begin = 0; begin < shapeOf.length;) {
    let end = begin;
    while (end < shapeOf.length && shapeOf[end] === shapeOf[begin]) end++;
    const borders = yield* bordersIn(joined, begin, end);
    if (borders !== undefined) {
      const first = faces.length;
      for (let from = begin; from < end;) {
        let to = from;
        while (to < end && faceOf[to] === faceOf[from]) to++;
        faces.push(rangeOf(joined, from, to, tolerance));
        from = to;
        yield PAUSE;
      }
      addRims(joined, borders, { faces, first, rims });
    }
    begin = end;
    yield PAUSE;
  }
  return { faces, rims };
}

/** Edge between two faces, in the direction that it has in the left one. Faces are those of `faceOf`. */
interface Border {
  readonly from: number;
  readonly to: number;
  readonly left: number;
  readonly right: number;
}

/**
 * Returns the edges between the faces of a shape; undefined if there are none, the shape is not closed, or edges have more than
 * two triangles.
 */
function* bordersIn(joined: JoinedShapes, begin: number, end: number): Steps<Border[] | undefined> {
  const { triangles, faceOf, isDropped } = joined;
  if (faceOf[begin] === faceOf[end - 1]) return undefined;
  const faceOfEdge = new Map<number, number>();
  let repeated = 0;
  yield* stepwise(end - begin, (i) => {
    const t = begin + i;
    if (isDropped[t] === 1) return;
    for (let k = 0; k < 3; k++) {
      const key = directedKey(triangles[3 * t + k] ?? 0, triangles[3 * t + ((k + 1) % 3)] ?? 0);
      if (faceOfEdge.has(key)) repeated++;
      faceOfEdge.set(key, faceOf[t] ?? 0);
    }
  });
  const borders: Border[] = [];
  for (const [key, left] of faceOfEdge) {
    const [from, to] = [Math.floor(key / STRIDE), key % STRIDE];
    const right = faceOfEdge.get(directedKey(to, from));
    if (right === undefined) return undefined;
    if (left < right) borders.push({ from, to, left, right });
  }
  return repeated === 0 && borders.length > 0 ? borders : undefined;
}

function rangeOf(joined: JoinedShapes, begin: number, end: number, tolerance: number): ShapeRange {
  const { triangles, shapeOf, isDropped } = joined;
  const nodes = new Set<number>();
  const corners: Corners[] = [];
  for (let t = begin; t < end; t++) {
    if (isDropped[t] === 1) continue;
    for (const node of triangles.subarray(3 * t, 3 * t + 3)) nodes.add(node);
    corners.push(cornersOf(joined, t));
  }
  const positions = [...nodes].map((node) => pointOf(joined.points, node));
  const extreme = (pick: (...values: number[]) => number) => (axis: number) =>
    positions.reduce((best, p) => pick(best, p[axis] ?? 0), positions[0]?.[axis] ?? 0);
  const [lowest, highest] = [extreme(Math.min), extreme(Math.max)];
  return {
    shape: shapeOf[begin] ?? 0,
    begin,
    end,
    rims: [],
    surface: fittedSurface(positions, corners, tolerance),
    low: [lowest(0), lowest(1), lowest(2)],
    high: [highest(0), highest(1), highest(2)],
  };
}

/** Where the rims of a shape go: its faces begin at `first`. */
interface RimsOfShape {
  readonly faces: readonly ShapeRange[];
  readonly first: number;
  readonly rims: Rim[];
}

function addRims(
  joined: JoinedShapes,
  borders: readonly Border[],
  { faces, first, rims }: RimsOfShape,
): void {
  const numberOf = new Map<number, number>();
  for (let f = first; f < faces.length; f++) numberOf.set(joined.faceOf[faces[f]?.begin ?? 0] ?? 0, f);
  const degree = new Map<number, number>();
  for (const { from, to } of borders)
    for (const node of [from, to]) degree.set(node, (degree.get(node) ?? 0) + 1);
  const pairs = new Map<number, Border[]>();
  for (const border of borders) {
    const key = directedKey(border.left, border.right);
    const known = pairs.get(key);
    if (known === undefined) pairs.set(key, [border]);
    else known.push(border);
  }
  for (const pair of pairs.values()) {
    const [left, right] = [pair[0]?.left ?? 0, pair[0]?.right ?? 0].map((face) => numberOf.get(face) ?? 0);
    if (left === undefined || right === undefined) continue;
    for (const nodes of chainsOf(pair, (node) => degree.get(node) === 2, joined.points)) {
      faces[left]?.rims.push(rims.length);
      faces[right]?.rims.push(rims.length);
      rims.push({ shape: faces[left]?.shape ?? 0, faces: [left, right], nodes });
    }
  }
}

/** Returns the edges between two faces in chains, which end at corners. */
function chainsOf(
  borders: readonly Border[],
  isInner: (node: number) => boolean,
  points: Float64Array,
): number[][] {
  const after = new Map(borders.map(({ from, to }) => [from, to]));
  const previous = new Map(borders.map(({ from, to }) => [to, from]));
  const isCorner = (node: number): boolean => {
    const [a, b] = [previous.get(node), after.get(node)];
    if (!isInner(node) || a === undefined || b === undefined) return true;
    const p = pointOf(points, node);
    const [u, v] = [minus(p, pointOf(points, a)), minus(pointOf(points, b), p)];
    return dot(u, v) < CORNER * lengthOf(u) * lengthOf(v);
  };
  const chains: number[][] = [];
  const isUsed = new Set<number>();
  const follow = (start: number): void => {
    const chain = [start];
    for (let node = after.get(start); node !== undefined; node = after.get(node)) {
      isUsed.add(chain.at(-1) ?? start);
      chain.push(node);
      if (node === start || isCorner(node)) break;
    }
    chains.push(chain);
  };
  for (const { from } of borders) if (isCorner(from)) follow(from);
  for (const { from } of borders) if (!isUsed.has(from)) follow(from);
  return chains;
}
