/**
 * The crossing test of the paper in the plane (Löhner & Parikh 1988, section 6): a new triangle against a side of the front, in
 * three layers. A node that both share is exempt; instead the side must not start into the triangle there, as in the engine's
 * plane front (cpp/src/surface/planar_front.cpp, isBlockedBy). Inequality (5) is printed the wrong way round; here a side does not cross if max (−αⁱ, αⁱ − 1) > t for one i.
 */
export type Point = readonly [number, number];

export interface Crossed {
  readonly a: Point;
  readonly b: Point;
  /** The third corner of the new triangle over the active side a b; counter-clockwise. */
  readonly p: Point;
  /** Ends of the side of the front. */
  readonly q: Point;
  readonly r: Point;
}

/** A new side of the triangle, from a or b to p, against the side of the front. */
export interface Pair {
  readonly from: Point;
  /** α¹ along the new side, α³ along the side of the front, α⁴ = 1 − α¹; infinite if they are parallel. */
  readonly alphas: readonly [number, number, number];
  /** By how much the α outside most is outside the interval from 0 to 1; negative within. */
  readonly excess: number;
  /** Where the two lines meet; null if they are parallel. */
  readonly at: Point | null;
  /** Whether both have a node in common, which is no crossing. */
  readonly isShared: boolean;
}

export interface CrossingVerdict {
  /** Gaps between the boxes along x and y, less the distance that counts as near. */
  readonly gaps: readonly [number, number];
  /** Shape functions of the new triangle at q and at r. */
  readonly shapes: readonly [Triple, Triple];
  /** The shape function by which layer b decides; null if none does. */
  readonly beyond: number | null;
  readonly pairs: readonly [Pair, Pair];
  /** The pair that decides, or that comes nearest to a crossing. */
  readonly decisive: Pair;
  /** The layer that decides: 1, 2 or 3. */
  readonly layer: 1 | 2 | 3;
  readonly isCrossing: boolean;
  /** Whether the side and a new side truly meet, without tolerance. */
  readonly meets: boolean;
  /** Where the side goes into the triangle from a corner that both share; null if it does not. */
  readonly entersAt: Point | null;
  /** Whether the whole side is within the triangle. */
  readonly isInside: boolean;
}

type Triple = readonly [number, number, number];

const distance = (a: Point, b: Point): number => Math.hypot(b[0] - a[0], b[1] - a[1]);

/** Returns twice the area of a triangle; positive for counter-clockwise corners. */
export const orient = (a: Point, b: Point, c: Point): number =>
  (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

export function testCrossing(crossed: Crossed, tolerance: number): CrossingVerdict {
  const { a, b, p, q, r } = crossed;
  const gaps = boxGaps(crossed, tolerance);
  const shapes = [shapesAt(crossed, q), shapesAt(crossed, r)] as const;
  const beyond = separatingShape(shapes, tolerance);
  const pairs = [pairOf(a, p, q, r), pairOf(b, p, q, r)] as const;
  const hits = pairs.filter(({ isShared, excess }) => !isShared && excess <= tolerance);
  const open = pairs.filter(({ isShared }) => !isShared);
  const nearest = [...(open.length > 0 ? open : pairs)].sort((x, y) => x.excess - y.excess)[0] ?? pairs[0];
  const entersAt = entryOf(crossed);
  const layer = Math.max(...gaps) > 0 ? 1 : beyond !== null ? 2 : 3;
  return {
    gaps,
    shapes,
    beyond,
    pairs,
    decisive: hits[0] ?? nearest,
    layer,
    isCrossing: layer === 3 && (hits.length > 0 || entersAt !== null),
    meets: pairs.some(({ isShared, excess }) => !isShared && excess <= 0),
    entersAt,
    isInside: shapes.every((shape) => shape.every((value) => value > 0)),
  };
}

/** Layer a, equation (7). Ends may overshoot by t, so boxes nearer than t times both lengths are not apart. */
function boxGaps({ a, b, p, q, r }: Crossed, tolerance: number): readonly [number, number] {
  const near = tolerance * (Math.max(distance(a, p), distance(b, p)) + distance(q, r));
  const gap = (i: 0 | 1): number => {
    const [low, high] = [Math.min(a[i], b[i], p[i]), Math.max(a[i], b[i], p[i])];
    return Math.max(Math.min(q[i], r[i]) - high, low - Math.max(q[i], r[i])) - near;
  };
  return [gap(0), gap(1)];
}

function shapesAt({ a, b, p }: Crossed, x: Point): Triple {
  const area = orient(a, b, p);
  return [orient(b, p, x) / area, orient(p, a, x) / area, orient(a, b, x) / area];
}

/** Layer b: both ends have a shape function on the same side outside [−t, 1 + t]. */
function separatingShape([atQ, atR]: readonly [Triple, Triple], t: number): number | null {
  const found = [0, 1, 2].find((i) => {
    const [u, v] = [atQ[i] ?? 0, atR[i] ?? 0];
    return (u < -t && v < -t) || (u > 1 + t && v > 1 + t);
  });
  return found ?? null;
}

/** Layer c, equation (1) in the plane: from + α¹ (p − from) = q + α³ (r − q). */
function pairOf(from: Point, p: Point, q: Point, r: Point): Pair {
  const [g1, g3, d] = [sub(p, from), sub(r, q), sub(q, from)];
  const area = g1[0] * g3[1] - g1[1] * g3[0];
  const isShared = [from, p].some((u) => [q, r].some((v) => distance(u, v) < 1e-9));
  if (area === 0)
    return { from, alphas: [Infinity, Infinity, -Infinity], excess: Infinity, at: null, isShared };
  const along = (d[0] * g3[1] - d[1] * g3[0]) / area;
  const other = (d[0] * g1[1] - d[1] * g1[0]) / area;
  const alphas = [along, other, 1 - along] as const;
  const excess = Math.max(...alphas.map((alpha) => Math.max(-alpha, alpha - 1)));
  return { from, alphas, excess, at: [from[0] + along * g1[0], from[1] + along * g1[1]], isShared };
}

/** A side between two corners is one of the triangle's own, and is closed by it. */
function entryOf({ a, b, p, q, r }: Crossed): Point | null {
  const corners = [a, b, p] as const;
  const cornerAt = (x: Point): number => corners.findIndex((corner) => distance(corner, x) < 1e-9);
  const [first, second] = [cornerAt(q), cornerAt(r)];
  if (first < 0 === second < 0) return null;
  const shared = Math.max(first, second);
  const [at, next, last] = [0, 1, 2].map((i) => corners[(shared + i) % 3] ?? a) as [Point, Point, Point];
  const end = first < 0 ? q : r;
  if (orient(at, next, end) < 0 || orient(at, end, last) < 0) return null;
  const share = Math.min(1, 0.08 / distance(at, end));
  return [at[0] + share * (end[0] - at[0]), at[1] + share * (end[1] - at[1])];
}

const sub = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1]];
