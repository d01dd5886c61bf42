/** Faces on one surface in the plane of its coordinates: where their curves meet, and one triangulation of them all. */
import type { Vector } from "../base/vectors.js";
import { type Constraint, constrainedTriangles, CrossingConstraints } from "./constrained-triangulation.js";
import type { FittedSurface, Uv } from "./fitted-surface.js";
import type { GrowingNodes } from "./growing-nodes.js";
import { directedKey, pairKey } from "./rims.js";

/** Edge of the curves of a group: a pair of nodes. */
export type Segment = readonly [from: number, to: number];

/** Nodes to be inserted into a segment. */
export interface Split {
  readonly segment: Segment;
  readonly node: number;
}

/** A segment, or a copy of one at the other end of the period. */
interface Piece {
  readonly segment: Segment;
  readonly from: Uv;
  readonly to: Uv;
}

/** A node or a copy of one. */
interface Spot {
  readonly node: number;
  readonly uv: Uv;
}

export class UnrolledGroup {
  readonly #surface: FittedSurface;
  readonly #nodes: GrowingNodes;
  readonly #tolerance: number;
  readonly #uvs = new Map<number, Uv>();
  /** Where the surface is cut open: the `u` that becomes 0. */
  readonly #cut: number;
  /** Whether faces go across the cut. */
  readonly #isCutThrough: boolean;

  constructor(
    surface: FittedSurface,
    nodes: GrowingNodes,
    { segments, tolerance }: { readonly segments: readonly Segment[]; readonly tolerance: number },
  ) {
    this.#surface = surface;
    this.#nodes = nodes;
    this.#tolerance = tolerance;
    const { cut, isThrough } = this.#chosenCut(segments);
    this.#cut = cut;
    this.#isCutThrough = isThrough;
    this.#uvs.clear();
  }

  /** Returns nodes where segments go across the cut. */
  splitsAtCut(segments: readonly Segment[]): Split[] {
    if (!this.#isCutThrough) return [];
    const { period } = this.#surface;
    return segments.flatMap((segment): Split[] => {
      const [a, b] = segment.map((node) => this.#uvOf(node));
      if (a === undefined || b === undefined) return [];
      if (this.#isOnCut(a) || this.#isOnCut(b) || Math.abs(a[0] - b[0]) <= period / 2) return [];
      const [low, high] = a[0] < b[0] ? [a, b] : [b, a];
      const share = low[0] / (low[0] + period - high[0]);
      const v = low[1] + share * (high[1] - low[1]);
      return [{ segment, node: this.#nodes.add(this.#position([0, v])) }];
    });
  }

  /** Returns the nodes where segments meet, apart from their ends. */
  crossings(segments: readonly Segment[]): Split[] {
    const pieces = this.#piecesOf(segments);
    const lowest = ({ from, to }: Piece) => Math.min(from[0], to[0]);
    const highest = ({ from, to }: Piece) => Math.max(from[0], to[0]);
    pieces.sort((a, b) => lowest(a) - lowest(b));
    const splits: Split[] = [];
    let active: Piece[] = [];
    for (const piece of pieces) {
      const low = lowest(piece) - this.#tolerance;
      active = active.filter((other) => highest(other) >= low);
      for (const other of active) splits.push(...this.#meetingOf(piece, other));
      active.push(piece);
    }
    return splits;
  }

  /**
   * Returns a triangulation of the plane in which all segments are edges: three nodes per triangle, counter-clockwise. Throws
   * CrossingConstraints if segments cross.
   */
  triangles(segments: readonly Segment[], inner: readonly number[]): Uint32Array {
    const spots: Spot[] = [];
    const spotOf = new Map<string, number>();
    const spotAt = (node: number, uv: Uv, isRight: boolean): number => {
      const key = `${node} ${isRight}`;
      const known = spotOf.get(key);
      if (known !== undefined) return known;
      spotOf.set(key, spots.length);
      return spots.push({ node, uv }) - 1;
    };
    const { period } = this.#surface;
    const isRight = (uv: Uv) => this.#isCutThrough && uv[0] >= period - this.#tolerance;
    const constraints: Constraint[] = this.#piecesOf(segments).map(({ segment: [a, b], from, to }) => [
      spotAt(a, from, isRight(from)),
      spotAt(b, to, isRight(to)),
    ]);
    if (this.#isCutThrough) constraints.push(...this.#cutConstraints(segments, spotAt));
    for (const node of inner) spotAt(node, this.#uvOf(node), false);
    const points = Float64Array.from(spots.flatMap(({ uv }) => [...uv]));
    const corners = constrainedTriangles(points, constraints);
    return corners.map((spot) => spots[spot]?.node ?? 0);
  }

  #cutConstraints(
    segments: readonly Segment[],
    spotAt: (node: number, uv: Uv, isRight: boolean) => number,
  ): Constraint[] {
    const onCut = [...new Set(segments.flat())].filter((node) => this.#isOnCut(this.#uvOf(node)));
    onCut.sort((a, b) => this.#uvOf(a)[1] - this.#uvOf(b)[1] || a - b);
    return onCut.slice(1).flatMap((node, i) => {
      const other = onCut[i] ?? 0;
      const ends = [other, node].map((one) => [one, this.#uvOf(one)[1]] as const);
      return [false, true].map((isRight): Constraint => {
        const u = isRight ? this.#surface.period : 0;
        const [a = 0, b = 0] = ends.map(([one, v]) => spotAt(one, [u, v], isRight));
        return [a, b];
      });
    });
  }

  #position([u, v]: Uv): Vector {
    const { period } = this.#surface;
    const back = u + this.#cut;
    return this.#surface.at([back >= period && period > 0 ? back - period : back, v]);
  }

  /** Returns the coordinates of a node, with `u` from the cut; 0 on it. */
  #uvOf(node: number): Uv {
    const known = this.#uvs.get(node);
    if (known !== undefined) return known;
    const uv = this.#shifted(this.#surface.uv(this.#nodes.positionOf(node)));
    this.#uvs.set(node, uv);
    return uv;
  }

  #shifted([u, v]: Uv): Uv {
    const { period } = this.#surface;
    if (period === 0) return [u, v];
    const shifted = u >= this.#cut ? u - this.#cut : u - this.#cut + period;
    const isOnCut = this.#isCutThrough && Math.min(shifted, period - shifted) <= this.#tolerance;
    return [isOnCut ? 0 : shifted, v];
  }

  #isOnCut([u]: Uv): boolean {
    return this.#isCutThrough && u === 0;
  }

  /** Returns the segments, those along the cut at both of its sides. */
  #piecesOf(segments: readonly Segment[]): Piece[] {
    const { period } = this.#surface;
    return segments.flatMap((segment): Piece[] => {
      const [from, to] = [this.#uvOf(segment[0]), this.#uvOf(segment[1])];
      const [isFrom, isTo] = [this.#isOnCut(from), this.#isOnCut(to)];
      const right = (uv: Uv): Uv => [uv[0] + period, uv[1]];
      if (isFrom && isTo)
        return [
          { segment, from, to },
          { segment, from: right(from), to: right(to) },
        ];
      if (isFrom && to[0] > period / 2) return [{ segment, from: right(from), to }];
      if (isTo && from[0] > period / 2) return [{ segment, from, to: right(to) }];
      return [{ segment, from, to }];
    });
  }

  #meetingOf(one: Piece, other: Piece): Split[] {
    const [a, b, c, d] = [one.from, one.to, other.from, other.to];
    const tolerance = this.#tolerance;
    const isApart = [0, 1].some(
      (k) =>
        Math.max(a[k] ?? 0, b[k] ?? 0) < Math.min(c[k] ?? 0, d[k] ?? 0) - tolerance ||
        Math.max(c[k] ?? 0, d[k] ?? 0) < Math.min(a[k] ?? 0, b[k] ?? 0) - tolerance,
    );
    if (isApart) return [];
    const splits: Split[] = [];
    const [oneNodes, otherNodes] = [one.segment, other.segment];
    if (pairKey(...oneNodes) === pairKey(...otherNodes)) return [];
    const offer = (node: number, uv: Uv, piece: Piece) => {
      if (piece.segment.includes(node) || !isInside(uv, piece, tolerance)) return false;
      splits.push({ segment: piece.segment, node });
      return true;
    };
    // All four are tried: segments along one line may begin and end inside each other.
    const meets = [
      offer(oneNodes[0], a, other),
      offer(oneNodes[1], b, other),
      offer(otherNodes[0], c, one),
      offer(otherNodes[1], d, one),
    ].some(Boolean);
    if (meets || oneNodes.some((node) => otherNodes.includes(node))) return splits;
    const [ofC, ofD, ofA, ofB] = [side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)];
    if (!(ofC * ofD < 0 && ofA * ofB < 0)) return splits;
    const share = ofA / (ofA - ofB);
    const uv: Uv = [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
    const node = this.#nodes.add(this.#position(uv));
    for (const { segment } of [one, other]) if (!segment.includes(node)) splits.push({ segment, node });
    return splits;
  }

  #chosenCut(segments: readonly Segment[]): { readonly cut: number; readonly isThrough: boolean } {
    const { period } = this.#surface;
    if (period === 0) return { cut: 0, isThrough: false };
    const spans = segments.map(([from, to]) => {
      const [a, b] = [this.#plainU(from), this.#plainU(to)];
      const step = (b - a + period) % period;
      return step <= period / 2 ? { begin: a, length: step } : { begin: b, length: period - step };
    });
    const gap = widestGap(spans, period);
    if (gap.width > 100 * this.#tolerance) return { cut: gap.middle, isThrough: false };
    const ruling = spans.find(({ length }) => length <= this.#tolerance);
    const first = segments[0]?.[0];
    return { cut: ruling?.begin ?? (first === undefined ? 0 : this.#plainU(first)), isThrough: true };
  }

  #plainU(node: number): number {
    return this.#surface.uv(this.#nodes.positionOf(node))[0];
  }
}

interface Span {
  readonly begin: number;
  readonly length: number;
}

/** Returns the widest part of the period that no span covers. */
function widestGap(
  spans: readonly Span[],
  period: number,
): { readonly width: number; readonly middle: number } {
  const sorted = spans.toSorted((a, b) => a.begin - b.begin);
  let reached = sorted.reduce((most, { begin, length }) => Math.max(most, begin + length - period), 0);
  let best = { width: 0, middle: 0 };
  for (const { begin, length } of [...sorted, { begin: period + (sorted[0]?.begin ?? 0), length: 0 }]) {
    const width = begin - reached;
    if (width > best.width) best = { width, middle: (reached + width / 2) % period };
    reached = Math.max(reached, begin + length);
  }
  return best;
}

const side = (a: Uv, b: Uv, c: Uv): number => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/** Returns whether a position is on a piece, apart from its ends. */
function isInside(uv: Uv, { from, to }: Piece, tolerance: number): boolean {
  const [x, y] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.sqrt(x * x + y * y);
  if (!(length > 0)) return false;
  const along = ((uv[0] - from[0]) * x + (uv[1] - from[1]) * y) / length;
  return (
    along > tolerance && along < length - tolerance && Math.abs(side(from, to, uv)) <= tolerance * length
  );
}

/**
 * Returns the triangles of a face among those of its group, oriented as the face is: those that can be reached from its
 * border without crossing it. `border`: pairs of nodes with the face on their left, counter-clockwise in the group's plane.
 */
export function trianglesWithin(triangles: Uint32Array, border: readonly Segment[]): number[] {
  const ownerOf = new Map<number, number>();
  triangles.forEach((node, corner) => {
    const after = triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? 0;
    ownerOf.set(directedKey(node, after), Math.floor(corner / 3));
  });
  const barrier = new Set(border.map(([a, b]) => pairKey(a, b)));
  const open = border.map(([a, b]) => {
    const first = ownerOf.get(directedKey(a, b));
    if (first === undefined) throw new CrossingConstraints();
    return first;
  });
  const found = new Set<number>(open);
  for (let t = open.pop(); t !== undefined; t = open.pop()) {
    for (let k = 0; k < 3; k++) {
      const [a, b] = [triangles[3 * t + k] ?? 0, triangles[3 * t + ((k + 1) % 3)] ?? 0];
      if (barrier.has(pairKey(a, b))) continue;
      const beside = ownerOf.get(directedKey(b, a));
      if (beside === undefined) throw new CrossingConstraints();
      if (!found.has(beside)) {
        found.add(beside);
        open.push(beside);
      }
    }
  }
  return [...found].sort((a, b) => a - b);
}
