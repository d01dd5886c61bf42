/**
 * Polygons of files cut into triangles: those that lie around their first corner, as convex ones do, from there,
 * which changes nothing about a plane one; others by clipping ears (Meisters 1975), the best first, in the plane of the
 * two axes that shows them largest. Every corner stays one, also on a straight edge, where the faces beside may have
 * theirs; that is why no library for the drawing of polygons does this, for those leave such corners out.
 */
import { ChainTree, EMPTY_BOX, type Work } from "./chain-tree.js";
import { EarQueue } from "./ear-queue.js";
import type { Coordinates } from "./sixfold-volume.js";

export type Triple = readonly [number, number, number];
/** In a plane. */
export type Place = readonly [number, number];

/** What the readers say where there are no such triangles. */
export const UNCUT = "cannot be cut into triangles: it crosses itself, has no area, or has too many corners";

/** Twice the area of a triangle, relative to products of its coordinates, below which rounding has its sign. */
const ROUNDING = 1e-14;

/**
 * Adds the triangles of a polygon of three or more corners. False, and nothing added, where that cannot be done
 * safely: it crosses itself, has no area, or takes more work than is allowed. O(n) around the first corner, else
 * O(n log n) for n corners as they come, and never more than the budget has.
 */
export function addPolygon(
  corners: readonly number[],
  points: Coordinates,
  triangles: number[],
  budget = new ClippingBudget(),
): boolean {
  if (corners.length === 3 || isFan(corners, points)) {
    for (let i = 2; i < corners.length; i++) {
      triangles.push(corners[0] ?? 0, corners[i - 1] ?? 0, corners[i] ?? 0);
    }
    return true;
  }
  const places = flattened(corners, points);
  const ears = budget.spend(corners.length, (work) =>
    crossesItself(places, work) ? undefined : clippedEars(places, work),
  );
  if (ears === undefined) return false;
  for (const corner of ears) triangles.push(corners[corner] ?? 0);
  return true;
}

/**
 * How much clipping a file may ask for. Usual polygons take some dozens of steps for each corner, which are as free as the
 * reading of their text; hostile ones take as many as there are pairs of corners, up to a second or some for the file.
 */
export class ClippingBudget {
  #left = 4 * MOST_FOR_POLYGON;
  #sinceRest = 0;
  readonly #onLongWork: () => void;

  /** `onLongWork` is called behind polygons that took some milliseconds together. */
  constructor(onLongWork: () => void = () => undefined) {
    this.#onLongWork = onLongWork;
  }

  /** What `use` gives, which takes its steps from the budget. */
  spend<T>(corners: number, use: (work: Work) => T): T {
    const free = FREE_PER_CORNER * corners;
    const work = { left: free + Math.min(this.#left, MOST_FOR_POLYGON) };
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
const MOST_FOR_POLYGON = 2e7;
/** Some milliseconds. */
const LONG_WORK = 1e5;

/** Whether all triangles from the first corner turn as the whole polygon does, less than once around it together. */
function isFan(corners: readonly number[], points: Coordinates): boolean {
  const places = corners.map((corner) => placeOf(points, corner));
  const [first = ORIGIN, second = ORIGIN] = places;
  const whole = wholeNormal(corners, points);
  const turnOf = (a: Triple, b: Triple) => {
    const n = normal(first, a, b);
    return n[0] * whole[0] + n[1] * whole[1] + n[2] * whole[2];
  };
  let isPastHalf = false;
  return places.every((place, i) => {
    if (i < 2) return true;
    const side = turnOf(second, place);
    if (isPastHalf && side >= 0) return false;
    isPastHalf ||= side < 0;
    return turnOf(places[i - 1] ?? ORIGIN, place) > 0;
  });
}

const ORIGIN: Triple = [0, 0, 0];

/** Seen along the axis nearest to the polygon's normal, so that it runs counter-clockwise. */
function flattened(corners: readonly number[], points: Coordinates): readonly Place[] {
  const view = flatView(corners, points);
  return corners.map((corner) => view(placeOf(points, corner)));
}

/** How places in the polygon's plane are seen so. */
export function flatView(corners: readonly number[], points: Coordinates): (place: Triple) => Place {
  const whole = wholeNormal(corners, points);
  const [x, y, z] = whole.map(Math.abs) as [number, number, number];
  const axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const isSeenFromBehind = whole[axis] < 0;
  return (place) => {
    const [first, second] = [place[u] ?? 0, place[v] ?? 0];
    return isSeenFromBehind ? [second, first] : [first, second];
  };
}

/** Whether two edges cross within both; ears would be found all the same, one over another. So where work runs out. */
function crossesItself(places: readonly Place[], work: Work): boolean {
  const begin = (i: number): Place => places[i] ?? [0, 0];
  const end = (i: number): Place => begin(i + 1 === places.length ? 0 : i + 1);
  const boxes = new Float64Array(4 * places.length);
  places.forEach((_, i) => setBox(boxes, 4 * i, begin(i), end(i)));
  return new ChainTree(boxes).somePair(work, (i, j) => {
    const [a, b, c, d] = [begin(i), end(i), begin(j), end(j)];
    return isBetween(a, b, c, d) && isBetween(c, d, a, b);
  });
}

/** Lowest x y, highest x y of up to three places, from position `at` on. */
function setBox(boxes: Float64Array, at: number, p: Place, q: Place = p, r: Place = q): Float64Array {
  boxes[at] = Math.min(p[0], q[0], r[0]);
  boxes[at + 1] = Math.min(p[1], q[1], r[1]);
  boxes[at + 2] = Math.max(p[0], q[0], r[0]);
  boxes[at + 3] = Math.max(p[1], q[1], r[1]);
  return boxes;
}

/** Whether the line through a and b has c on one side and d on the other. */
function isBetween(a: Place, b: Place, c: Place, d: Place): boolean {
  const [left, right] = [turn(a, b, c), turn(a, b, d)];
  return (left > 0 && right < 0) || (left < 0 && right > 0);
}

/**
 * Positions of corners, three for each triangle, counter-clockwise; undefined where no ear is left. A triangle is an ear
 * where no corner at which the polygon is not convex lies in it; corners only ever become convex while others go.
 */
function clippedEars(places: readonly Place[], work: Work): number[] | undefined {
  const count = places.length;
  const next = places.map((_, i) => (i + 1) % count);
  const before = places.map((_, i) => (i + count - 1) % count);
  const at = (corner: number): Place => places[corner] ?? [0, 0];
  const turnAt = (i: number): number => turn(at(before[i] ?? 0), at(i), at(next[i] ?? 0));
  const boxes = new Float64Array(4 * count);
  places.forEach((place, i) => {
    if (turnAt(i) > 0) boxes.set(EMPTY_BOX, 4 * i);
    else setBox(boxes, 4 * i, place);
  });
  const blocking = new ChainTree(boxes);
  const around = new Float64Array(4);
  const queue = new EarQueue(count);
  places.forEach((_, i) => queue.put(i, worthAt(i)));
  const ears: number[] = [];
  for (let left = count; left > 2;) {
    const best = queue.take();
    if (best === undefined || work.left < 0) return undefined;
    const [a, b] = [before[best] ?? 0, next[best] ?? 0];
    // What is in the way stays so until a neighbour goes, with which the corner comes back.
    if (left > 3 && isBlocked(at(a), at(best), at(b))) continue;
    ears.push(a, best, b);
    next[a] = b;
    before[b] = a;
    left--;
    for (const corner of [a, b]) {
      if (turnAt(corner) > 0) blocking.drop(corner);
      queue.put(corner, worthAt(corner));
    }
  }
  return ears;

  /** How good the triangle at a corner is; not above 0 where it turns the other way or is none. */
  function worthAt(corner: number): number {
    const [p, q, r] = [at(before[corner] ?? 0), at(corner), at(next[corner] ?? 0)];
    return turn(p, q, r) / Math.max(squared(p, q), squared(q, r), squared(r, p));
  }

  function isBlocked(p: Place, q: Place, r: Place): boolean {
    return blocking.someMeeting(setBox(around, 0, p, q, r), work, (i) => {
      const place = at(i);
      const isCorner = isSame(place, p) || isSame(place, q) || isSame(place, r);
      return !isCorner && turn(p, q, place) >= 0 && turn(q, r, place) >= 0 && turn(r, p, place) >= 0;
    });
  }
}

/** Twice the area of a triangle, above 0 where it runs counter-clockwise; 0 where rounding has the sign. */
export function turn(a: Place, b: Place, c: Place): number {
  const left = (b[0] - a[0]) * (c[1] - a[1]);
  const right = (b[1] - a[1]) * (c[0] - a[0]);
  return Math.abs(left - right) > ROUNDING * (Math.abs(left) + Math.abs(right)) ? left - right : 0;
}

function isSame(a: Place, b: Place): boolean {
  return a[0] === b[0] && a[1] === b[1];
}

function squared(a: Place, b: Place): number {
  return (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2;
}

/** Twice the polygon's area, along its normal. */
function wholeNormal(corners: readonly number[], points: Coordinates): Triple {
  const first = placeOf(points, corners[0] ?? 0);
  let [x, y, z] = [0, 0, 0];
  for (let i = 2; i < corners.length; i++) {
    const n = normal(first, placeOf(points, corners[i - 1] ?? 0), placeOf(points, corners[i] ?? 0));
    [x, y, z] = [x + n[0], y + n[1], z + n[2]];
  }
  return [x, y, z];
}

function placeOf(points: Coordinates, corner: number): Triple {
  return [points.at(3 * corner) ?? 0, points.at(3 * corner + 1) ?? 0, points.at(3 * corner + 2) ?? 0];
}

function normal(a: Triple, b: Triple, c: Triple): Triple {
  const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
}
