/**
 * Polygons of files cut into triangles: those that lie around their first corner, as convex ones do, from there,
 * which changes nothing about a plane one; others by clipping ears (Meisters 1975), in the plane of the two axes that shows them largest. Every
 * corner stays one, also on a straight edge, where the faces beside may have theirs; that is why no library
 * for the drawing of polygons does this, for those leave such corners out.
 */

type Triple = readonly [number, number, number];
type Place = readonly [number, number];

/** x y z per node, to be looked up by position. */
interface Coordinates {
  at(index: number): number | undefined;
}

/** What the readers say where there are no such triangles. */
export const UNCUT = "cannot be cut into triangles: it crosses itself, has no area, or has too many corners";

/** Clipping takes quadratic time; hostile files have larger ones. */
const MOST_CORNERS = 5000;
/** Twice the area of a triangle, relative to products of its coordinates, below which rounding has its sign. */
const ROUNDING = 1e-14;

/**
 * Adds the triangles of a polygon of three or more corners. False, and nothing added, where that cannot be done
 * safely: it crosses itself, has no area, or is not convex and has more than 5000 corners. O(n²), O(n) for convex ones.
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
  if (corners.length > MOST_CORNERS || !budget.covers(corners.length)) return false;
  const places = flattened(corners, points);
  if (crossesItself(places)) return false;
  const ears = clippedEars(places);
  if (ears === undefined) return false;
  for (const corner of ears) triangles.push(corners[corner] ?? 0);
  return true;
}

/** How much clipping a file may ask for: a few polygons of thousands of corners, any number of those of a hundred. */
export class ClippingBudget {
  #left = 20 * MOST_CORNERS ** 2;

  covers(corners: number): boolean {
    this.#left -= corners * Math.max(0, corners - FREE_CORNERS);
    return this.#left >= 0;
  }
}

/** Polygons of so many corners are clipped as fast as their text is read. */
const FREE_CORNERS = 100;

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
  const whole = wholeNormal(corners, points);
  const [x, y, z] = whole.map(Math.abs) as [number, number, number];
  const axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const isSeenFromBehind = whole[axis] < 0;
  return corners.map((corner) => {
    const place = placeOf(points, corner);
    const [first, second] = [place[u] ?? 0, place[v] ?? 0];
    return isSeenFromBehind ? [second, first] : [first, second];
  });
}

/**
 * Whether two edges cross within both; ears would be found all the same, one over another. Only edges whose ranges along
 * the first axis meet are tried.
 */
function crossesItself(places: readonly Place[]): boolean {
  const edges = places.map((place, i): readonly [Place, Place] => {
    const before = places.at(i - 1) ?? place;
    return before[0] <= place[0] ? [before, place] : [place, before];
  });
  edges.sort(([a], [b]) => a[0] - b[0]);
  for (const [i, [a, b]] of edges.entries()) {
    for (let j = i + 1; j < edges.length; j++) {
      const [c, d] = edges[j] ?? [b, b];
      if (c[0] > b[0]) break;
      if (isBetween(a, b, c, d) && isBetween(c, d, a, b)) return true;
    }
  }
  return false;
}

/** Whether the line through a and b has c on one side and d on the other. */
function isBetween(a: Place, b: Place, c: Place, d: Place): boolean {
  const [left, right] = [turn(a, b, c), turn(a, b, d)];
  return (left > 0 && right < 0) || (left < 0 && right > 0);
}

/** Positions of corners, three for each triangle, counter-clockwise; undefined where no ear is left. */
function clippedEars(places: readonly Place[]): number[] | undefined {
  const count = places.length;
  const next = places.map((_, i) => (i + 1) % count);
  const before = places.map((_, i) => (i + count - 1) % count);
  const at = (corner: number): Place => places[corner] ?? [0, 0];
  /** Of the ear at each corner: how good its triangle is, above 0; 0 where there is none. */
  const worth = places.map((_, i) => worthAt(i));
  const ears: number[] = [];
  let start = 0;
  for (let left = count; left > 3; left--) {
    let best = start;
    for (let i = next[start] ?? 0; i !== start; i = next[i] ?? 0) {
      if ((worth[i] ?? 0) > (worth[best] ?? 0)) best = i;
    }
    if (worth[best] === 0) return undefined;
    const [a, b] = [before[best] ?? 0, next[best] ?? 0];
    ears.push(a, best, b);
    next[a] = b;
    before[b] = a;
    start = a;
    worth[a] = worthAt(a);
    worth[b] = worthAt(b);
  }
  const [a, b] = [before[start] ?? 0, next[start] ?? 0];
  if (!(turn(at(a), at(start), at(b)) > 0)) return undefined;
  ears.push(a, start, b);
  return ears;

  function worthAt(corner: number): number {
    const [a, b] = [before[corner] ?? 0, next[corner] ?? 0];
    const [p, q, r] = [at(a), at(corner), at(b)];
    const area = turn(p, q, r);
    if (!(area > 0)) return 0;
    const [low, high] = [Math.min(p[0], q[0], r[0]), Math.max(p[0], q[0], r[0])];
    const [bottom, top] = [Math.min(p[1], q[1], r[1]), Math.max(p[1], q[1], r[1])];
    for (let i = next[b] ?? 0; i !== a; i = next[i] ?? 0) {
      const place = at(i);
      if (place[0] < low || place[0] > high || place[1] < bottom || place[1] > top) continue;
      const isCorner = isSame(place, p) || isSame(place, q) || isSame(place, r);
      if (!isCorner && turn(p, q, place) >= 0 && turn(q, r, place) >= 0 && turn(r, p, place) >= 0) return 0;
    }
    return area / Math.max(squared(p, q), squared(q, r), squared(r, p));
  }
}

/** Twice the area of a triangle, above 0 where it runs counter-clockwise; 0 where rounding has the sign. */
function turn(a: Place, b: Place, c: Place): number {
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
