/**
 * Cuts polygons of files into triangles. A polygon that is star-shaped about its first corner, such as a convex
 * one, becomes a fan, which does not change a plane polygon. Others are cut by ear clipping (Meisters 1975), best
 * ear first, in the coordinate plane in which they appear largest. Every corner remains a node, also on a straight
 * edge, where neighbouring faces may have theirs. Libraries that triangulate polygons for drawing drop such
 * corners, so none is used.
 */
import { ChainTree, EMPTY_BOX, type Work } from "./chain-tree.js";
import { EarQueue } from "./ear-queue.js";
import type { Coordinates } from "./sixfold-volume.js";

export type Position3 = readonly [number, number, number];
/** Position in a plane. */
export type Position2 = readonly [number, number];

/** Message of readers about polygons that cannot be cut. */
export const UNCUT =
  "cannot be cut into triangles: it intersects itself, has no area, or has too many corners";

/** Below this multiple of the products of coordinates, rounding decides the sign of an area. */
const ROUNDING = 1e-14;

/**
 * Adds the triangles of a polygon of three or more corners. Returns false, and adds nothing, if this cannot be done
 * safely: the polygon intersects itself, has no area, or needs more work than allowed. A fan costs O(n). Ear
 * clipping costs O(n log n) for typical polygons of n corners, and never exceeds the budget.
 */
export function addPolygon(
  corners: readonly number[],
  points: Coordinates,
  triangles: number[],
  budget = new ClippingBudget(),
): boolean {
  if (corners.length === 3 || canFan(corners, points)) {
    for (let i = 2; i < corners.length; i++) {
      triangles.push(corners[0] ?? 0, corners[i - 1] ?? 0, corners[i] ?? 0);
    }
    return true;
  }
  const positions = flattened(corners, points);
  const ears = budget.spend(corners.length, (work) =>
    crossesItself(positions, work) ? undefined : clippedEars(positions, work),
  );
  if (ears === undefined) return false;
  for (const corner of ears) triangles.push(corners[corner] ?? 0);
  return true;
}

/**
 * Limits the cost of ear clipping per file. Typical polygons need a few dozen steps per corner, which are free like
 * the parsing of their text. Malicious ones need a step per pair of corners; the budget limits them to about a
 * second per file.
 */
export class ClippingBudget {
  #left = 4 * MAX_POLYGON_WORK;
  #sinceRest = 0;
  readonly #onLongWork: () => void;

  /** `onLongWork` is called after polygons that took a few milliseconds together. */
  constructor(onLongWork: () => void = () => undefined) {
    this.#onLongWork = onLongWork;
  }

  /** Returns the result of `use`, which takes its steps from the budget. */
  spend<T>(corners: number, use: (work: Work) => T): T {
    const free = FREE_PER_CORNER * corners;
    const work = { left: free + Math.min(this.#left, MAX_POLYGON_WORK) };
    const given = work.left;
    const result = use(work);
    const used = given - work.left;
    this.#left -= Math.max(0, used - free);
    this.#sinceRest += used;
    if (this.#sinceRest > LONG_WORK) {
      this.#sinceRest = 0;
      this.#onLongWork();
    }
    return result;
  }
}

const FREE_PER_CORNER = 200;
const MAX_POLYGON_WORK = 2e7;
/** Number of steps that take a few milliseconds. */
const LONG_WORK = 1e5;

/**
 * Returns whether every triangle of the fan from the first corner is oriented as the polygon, and the fan spans
 * less than a full turn.
 */
function canFan(corners: readonly number[], points: Coordinates): boolean {
  const positions = corners.map((corner) => positionOf(points, corner));
  const [first = ORIGIN, second = ORIGIN] = positions;
  const whole = wholeNormal(corners, points);
  const areaAlongNormal = (a: Position3, b: Position3) => {
    const n = normal(first, a, b);
    return n[0] * whole[0] + n[1] * whole[1] + n[2] * whole[2];
  };
  let isPastHalf = false;
  return positions.every((position, i) => {
    if (i < 2) return true;
    const side = areaAlongNormal(second, position);
    if (isPastHalf && side >= 0) return false;
    isPastHalf ||= side < 0;
    return areaAlongNormal(positions[i - 1] ?? ORIGIN, position) > 0;
  });
}

const ORIGIN: Position3 = [0, 0, 0];

/**
 * Projects the corners along the coordinate axis nearest to the polygon's normal, so that they run
 * counter-clockwise.
 */
function flattened(corners: readonly number[], points: Coordinates): readonly Position2[] {
  const view = flatView(corners, points);
  return corners.map((corner) => view(positionOf(points, corner)));
}

/** Returns the projection that `flattened` uses for this polygon. */
export function flatView(
  corners: readonly number[],
  points: Coordinates,
): (position: Position3) => Position2 {
  const whole = wholeNormal(corners, points);
  const [x, y, z] = whole.map(Math.abs) as [number, number, number];
  const axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const isSeenFromBehind = whole[axis] < 0;
  return (position) => {
    const [first, second] = [position[u] ?? 0, position[v] ?? 0];
    return isSeenFromBehind ? [second, first] : [first, second];
  };
}

/**
 * Returns whether two edges cross in their interiors; ear clipping would not notice and make overlapping triangles.
 * Also true if the work limit is reached.
 */
function crossesItself(positions: readonly Position2[], work: Work): boolean {
  const begin = (i: number): Position2 => positions[i] ?? [0, 0];
  const end = (i: number): Position2 => begin(i + 1 === positions.length ? 0 : i + 1);
  const boxes = new Float64Array(4 * positions.length);
  positions.forEach((_, i) => setBox(boxes, 4 * i, begin(i), end(i)));
  return new ChainTree(boxes).somePair(work, (i, j) => {
    const [a, b, c, d] = [begin(i), end(i), begin(j), end(j)];
    return isBetween(a, b, c, d) && isBetween(c, d, a, b);
  });
}

/** Sets the box of up to three positions: lowest x y, highest x y, from index `at` on. */
function setBox(
  boxes: Float64Array,
  at: number,
  p: Position2,
  q: Position2 = p,
  r: Position2 = q,
): Float64Array {
  boxes[at] = Math.min(p[0], q[0], r[0]);
  boxes[at + 1] = Math.min(p[1], q[1], r[1]);
  boxes[at + 2] = Math.max(p[0], q[0], r[0]);
  boxes[at + 3] = Math.max(p[1], q[1], r[1]);
  return boxes;
}

/** Returns whether the line through a and b separates c and d. */
function isBetween(a: Position2, b: Position2, c: Position2, d: Position2): boolean {
  const [left, right] = [doubledArea(a, b, c), doubledArea(a, b, d)];
  return (left > 0 && right < 0) || (left < 0 && right > 0);
}

/**
 * Returns three corner indices per triangle, counter-clockwise; undefined if no ear is left. A corner is an ear if
 * its triangle contains no reflex corner. While others are removed, a corner may become convex, but never reflex.
 */
function clippedEars(positions: readonly Position2[], work: Work): number[] | undefined {
  const count = positions.length;
  const next = positions.map((_, i) => (i + 1) % count);
  const before = positions.map((_, i) => (i + count - 1) % count);
  const at = (corner: number): Position2 => positions[corner] ?? [0, 0];
  const areaAt = (i: number): number => doubledArea(at(before[i] ?? 0), at(i), at(next[i] ?? 0));
  const boxes = new Float64Array(4 * count);
  positions.forEach((position, i) => {
    if (areaAt(i) > 0) boxes.set(EMPTY_BOX, 4 * i);
    else setBox(boxes, 4 * i, position);
  });
  const blocking = new ChainTree(boxes);
  const around = new Float64Array(4);
  const queue = new EarQueue(count);
  positions.forEach((_, i) => queue.put(i, priorityOf(i)));
  const ears: number[] = [];
  for (let left = count; left > 2;) {
    const best = queue.take();
    if (best === undefined || work.left < 0) return undefined;
    const [a, b] = [before[best] ?? 0, next[best] ?? 0];
    // A blocked ear stays blocked until a neighbour is removed, which puts it into the queue again.
    if (left > 3 && isBlocked(at(a), at(best), at(b))) continue;
    ears.push(a, best, b);
    next[a] = b;
    before[b] = a;
    left--;
    for (const corner of [a, b]) {
      if (areaAt(corner) > 0) blocking.drop(corner);
      queue.put(corner, priorityOf(corner));
    }
  }
  return ears;

  /** Returns the quality of the triangle at a corner; 0 or less if the corner is reflex or the triangle degenerate. */
  function priorityOf(corner: number): number {
    const [p, q, r] = [at(before[corner] ?? 0), at(corner), at(next[corner] ?? 0)];
    return doubledArea(p, q, r) / Math.max(squared(p, q), squared(q, r), squared(r, p));
  }

  function isBlocked(p: Position2, q: Position2, r: Position2): boolean {
    return blocking.someMeeting(setBox(around, 0, p, q, r), work, (i) => {
      const position = at(i);
      const isCorner = isSame(position, p) || isSame(position, q) || isSame(position, r);
      return (
        !isCorner &&
        doubledArea(p, q, position) >= 0 &&
        doubledArea(q, r, position) >= 0 &&
        doubledArea(r, p, position) >= 0
      );
    });
  }
}

/** Returns twice the area of a triangle, positive if counter-clockwise; 0 if rounding decides the sign. */
export function doubledArea(a: Position2, b: Position2, c: Position2): number {
  const left = (b[0] - a[0]) * (c[1] - a[1]);
  const right = (b[1] - a[1]) * (c[0] - a[0]);
  return Math.abs(left - right) > ROUNDING * (Math.abs(left) + Math.abs(right)) ? left - right : 0;
}

function isSame(a: Position2, b: Position2): boolean {
  return a[0] === b[0] && a[1] === b[1];
}

function squared(a: Position2, b: Position2): number {
  return (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2;
}

/** Returns the normal of the polygon, twice its area long. */
function wholeNormal(corners: readonly number[], points: Coordinates): Position3 {
  const first = positionOf(points, corners[0] ?? 0);
  let [x, y, z] = [0, 0, 0];
  for (let i = 2; i < corners.length; i++) {
    const n = normal(first, positionOf(points, corners[i - 1] ?? 0), positionOf(points, corners[i] ?? 0));
    [x, y, z] = [x + n[0], y + n[1], z + n[2]];
  }
  return [x, y, z];
}

function positionOf(points: Coordinates, corner: number): Position3 {
  return [points.at(3 * corner) ?? 0, points.at(3 * corner + 1) ?? 0, points.at(3 * corner + 2) ?? 0];
}

function normal(a: Position3, b: Position3, c: Position3): Position3 {
  const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
}
