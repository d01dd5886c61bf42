/**
 * Constrained Delaunay triangulation of the plane. Constraints are inserted by flipping the edges that cross them (S. W.
 * Sloan, "A fast algorithm for generating constrained Delaunay triangulations", Computers & Structures 47, 1993).
 */
import Delaunator from "delaunator";
import { incircle, orient2d } from "robust-predicates";

/** A pair of points that becomes an edge. */
export type Constraint = readonly [from: number, to: number];

/** Thrown for constraints that cross each other. */
export class CrossingConstraints extends Error {}

/**
 * Returns the triangles, three points each, counter-clockwise. `points`: x y per point, all different. Constraints meet in
 * points only; one with a point on it becomes two edges. Throws CrossingConstraints if others cross.
 */
export function constrainedTriangles(points: Float64Array, constraints: readonly Constraint[]): Uint32Array {
  return new ConstrainedTriangulation(points).with(constraints);
}

const next = (half: number): number => (half % 3 === 2 ? half - 2 : half + 1);
const before = (half: number): number => (half % 3 === 0 ? half + 2 : half - 1);

/** Half-edge e goes from `#corners[e]` to the next corner of its triangle, which is to its left. */
class ConstrainedTriangulation {
  readonly #points: Float64Array;
  readonly #count: number;
  readonly #corners: Uint32Array;
  readonly #twins: Int32Array;
  /** Per point: a half-edge that begins there. */
  readonly #leaving: Int32Array;
  readonly #fixed = new Set<number>();

  constructor(given: Float64Array) {
    this.#count = given.length / 2;
    this.#points = withFrame(given);
    const { triangles, halfedges } = new Delaunator(this.#points);
    this.#corners = triangles.slice();
    this.#twins = halfedges.slice();
    this.#orient();
    this.#leaving = new Int32Array(this.#points.length / 2).fill(-1);
    this.#corners.forEach((point, half) => (this.#leaving[point] = half));
  }

  with(constraints: readonly Constraint[]): Uint32Array {
    for (const [from, to] of constraints) this.#insert(from, to);
    this.#restore();
    const inside = (t: number) => [0, 1, 2].every((k) => this.#corner(3 * t + k) < this.#count);
    const kept = Array.from({ length: this.#corners.length / 3 }, (_, t) => t).filter(inside);
    return Uint32Array.from(kept.flatMap((t) => [...this.#corners.subarray(3 * t, 3 * t + 3)]));
  }

  /** The library orients all triangles alike, in coordinates whose y points down. */
  #orient(): void {
    if (this.#side(this.#corner(0), this.#corner(1), this.#corner(2)) > 0) return;
    const [corners, twins] = [this.#corners.slice(), this.#twins.slice()];
    // Half-edge k of a triangle takes the place of the one that it was seen from the other side.
    const mirrored = (half: number) => (half < 0 ? half : half - (half % 3) + (2 - (half % 3)));
    corners.forEach((_, half) => {
      this.#corners[mirrored(half)] = corners[next(half)] ?? 0;
      this.#twins[mirrored(half)] = mirrored(twins[half] ?? -1);
    });
  }

  #corner(half: number): number {
    return this.#corners[half] ?? 0;
  }

  /** Returns a positive number if c is to the left of the line from a to b. */
  #side(a: number, b: number, c: number): number {
    const p = this.#points;
    const at = (point: number, axis: number) => p[2 * point + axis] ?? 0;
    // The library takes the y axis to point down.
    return -orient2d(at(a, 0), at(a, 1), at(b, 0), at(b, 1), at(c, 0), at(c, 1));
  }

  #isInCircle([a, b, c]: readonly [number, number, number], d: number): boolean {
    const p = this.#points;
    const at = (point: number, axis: number) => p[2 * point + axis] ?? 0;
    const sign = incircle(at(a, 0), at(a, 1), at(b, 0), at(b, 1), at(c, 0), at(c, 1), at(d, 0), at(d, 1));
    return sign > 0;
  }

  #key(a: number, b: number): number {
    return Math.min(a, b) * (this.#points.length / 2) + Math.max(a, b);
  }

  /** Yields the half-edges that begin at a point. Points of the frame are never asked for, so the circle is closed. */
  *#around(point: number): Generator<number> {
    const first = this.#leaving[point] ?? -1;
    let half = first;
    for (let count = 0; half >= 0 && count < this.#corners.length; count++) {
      yield half;
      half = this.#twins[before(half)] ?? -1;
      if (half === first) return;
    }
    throw new CrossingConstraints();
  }

  #find(from: number, to: number): number | undefined {
    if (from >= this.#count) {
      const back = to < this.#count ? this.#find(to, from) : undefined;
      return back === undefined ? undefined : this.#twins[back];
    }
    for (const half of this.#around(from)) if (this.#corner(next(half)) === to) return half;
    return undefined;
  }

  #insert(from: number, to: number): void {
    if (from === to) return;
    if (this.#find(from, to) !== undefined) {
      this.#fixed.add(this.#key(from, to));
      return;
    }
    const { crossed, end } = this.#crossedBy(from, to);
    this.#flipAway(from, end, crossed);
    this.#fixed.add(this.#key(from, end));
    if (end !== to) this.#insert(end, to);
  }

  /** Returns the edges across the way to a point, up to the first point on the way. */
  #crossedBy(from: number, to: number): { readonly crossed: [number, number][]; readonly end: number } {
    const crossed: [number, number][] = [];
    for (const half of this.#around(from)) {
      const [right, left] = [this.#corner(next(half)), this.#corner(before(half))];
      const [onRight, onLeft] = [this.#side(from, to, right), this.#side(from, to, left)];
      if (onRight === 0 && this.#isAhead(from, to, right)) return { crossed, end: right };
      if (onRight < 0 && onLeft > 0) {
        let across = next(half);
        for (;;) {
          crossed.push([this.#corner(across), this.#corner(next(across))]);
          const twin = this.#twins[across] ?? -1;
          if (twin < 0) throw new CrossingConstraints();
          const apex = this.#corner(before(twin));
          if (apex === to) return { crossed, end: to };
          const side = this.#side(from, to, apex);
          if (side === 0) return { crossed, end: apex };
          across = side > 0 ? next(twin) : before(twin);
        }
      }
    }
    throw new CrossingConstraints();
  }

  #isAhead(from: number, to: number, point: number): boolean {
    const p = this.#points;
    const along = (axis: number) =>
      ((p[2 * to + axis] ?? 0) - (p[2 * from + axis] ?? 0)) *
      ((p[2 * point + axis] ?? 0) - (p[2 * from + axis] ?? 0));
    return along(0) + along(1) > 0;
  }

  #flipAway(from: number, to: number, crossed: [number, number][]): void {
    let left = 100 + crossed.length ** 2;
    for (let edge = crossed.shift(); edge !== undefined; edge = crossed.shift()) {
      if (this.#fixed.has(this.#key(...edge)) || left-- < 0) throw new CrossingConstraints();
      const half = this.#find(...edge);
      if (half === undefined) throw new CrossingConstraints();
      if (!this.#isConvexAround(half)) {
        crossed.push(edge);
        continue;
      }
      const diagonal = this.#flip(half);
      const [a, b] = [this.#corner(diagonal), this.#corner(next(diagonal))];
      const isAtEnd = [a, b].some((point) => point === from || point === to);
      if (!isAtEnd && this.#side(from, to, a) * this.#side(from, to, b) < 0) crossed.push([a, b]);
    }
  }

  #isConvexAround(half: number): boolean {
    const twin = this.#twins[half] ?? -1;
    if (twin < 0) return false;
    const [a, b] = [this.#corner(half), this.#corner(next(half))];
    const [left, right] = [this.#corner(before(half)), this.#corner(before(twin))];
    return this.#side(right, left, a) > 0 && this.#side(right, left, b) < 0;
  }

  /** Replaces an edge by the other diagonal of its quadrilateral; returns a half-edge of the diagonal. */
  #flip(half: number): number {
    const twin = this.#twins[half] ?? -1;
    const [a, b] = [this.#corner(half), this.#corner(next(half))];
    const [left, right] = [this.#corner(before(half)), this.#corner(before(twin))];
    const [beside, besideTwin] = [before(half), before(twin)];
    // Triangles (a, b, left) and (b, a, right) become (right, b, left) and (left, a, right).
    this.#corners[half] = right;
    this.#corners[twin] = left;
    this.#link(half, this.#twins[besideTwin] ?? -1);
    this.#link(twin, this.#twins[beside] ?? -1);
    this.#link(beside, besideTwin);
    this.#leaving[a] = next(twin);
    this.#leaving[b] = next(half);
    this.#leaving[left] = beside;
    this.#leaving[right] = besideTwin;
    return beside;
  }

  #link(half: number, twin: number): void {
    this.#twins[half] = twin;
    if (twin >= 0) this.#twins[twin] = half;
  }

  /** Flips edges that are not constraints until all are locally Delaunay. */
  #restore(): void {
    const queue = Array.from(this.#corners.keys());
    let left = 50 * this.#corners.length;
    for (let half = queue.pop(); half !== undefined && left > 0; half = queue.pop()) {
      left--;
      const twin = this.#twins[half] ?? -1;
      if (twin < 0) continue;
      const [a, b] = [this.#corner(half), this.#corner(next(half))];
      if (this.#fixed.has(this.#key(a, b)) || !this.#isConvexAround(half)) continue;
      const [opposite, apex] = [this.#corner(before(half)), this.#corner(before(twin))];
      if (!this.#isInCircle([a, b, opposite], apex)) continue;
      this.#flip(half);
      queue.push(half, next(half), twin, next(twin));
    }
  }
}

/** Share of the extent of the points by which the frame around them is larger. */
const FRAME = 10;

/** Adds four points far around all others, so that none of these is at the rim of the triangulation. */
function withFrame(given: Float64Array): Float64Array {
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  given.forEach((value, i) => {
    low[i % 2] = Math.min(low[i % 2] ?? value, value);
    high[i % 2] = Math.max(high[i % 2] ?? value, value);
  });
  const [x0 = 0, y0 = 0] = low;
  const [x1 = 0, y1 = 0] = high;
  const margin = FRAME * Math.max(x1 - x0, y1 - y0);
  const points = new Float64Array(given.length + 8);
  points.set(given);
  points.set(
    [x0 - margin, y0 - margin, x1 + margin, y0 - margin, x1 + margin, y1 + margin, x0 - margin, y1 + margin],
    given.length,
  );
  return points;
}
