/**
 * Gives the same nodes to curves that several shapes have in common: each shape was triangulated by itself, so the nodes along
 * a common circle are different points of it.
 */
import { PAUSE, type Steps } from "../base/steps.js";
import { cross, dot, lengthOf, minus, plus, pointOf, scaled, type Vector } from "../base/vectors.js";
import { type Frame, frameOf, turnOf } from "./fitted-surface.js";
import { type FacesAndRims, pairKey, type Rim } from "./rims.js";

/** Circle through the nodes of a rim. */
interface Circle {
  readonly centre: Vector;
  readonly radius: number;
  readonly frame: Frame;
}

/** Rims on one circle. */
interface Common {
  readonly circle: Circle;
  readonly rims: number[];
}

/** Turns of `turnOf` in a circle. */
const TURNS = 4;

/** Changes the nodes of rims so that those of several shapes on one curve have the same nodes where they overlap. */
export function* unifyCurves(found: FacesAndRims, points: Float64Array, tolerance: number): Steps<void> {
  const { rims } = found;
  const circles = rims.map((rim) => circleOf(rim, points, tolerance));
  for (const { circle, rims: members } of yield* commonCircles(rims, circles, { points, tolerance })) {
    const shapes = new Set(members.map((r) => rims[r]?.shape));
    if (shapes.size > 1) unifyCircle(circle, members, { found, points, tolerance });
    yield PAUSE;
  }
  unifyOthers(found, circles, points, tolerance);
}

const isClosed = ({ nodes }: Rim): boolean => nodes.length > 1 && nodes[0] === nodes.at(-1);

/** Returns the circle through all nodes of a rim; undefined if there is none, or the nodes do not define one. */
function circleOf(rim: Rim, points: Float64Array, tolerance: number): Circle | undefined {
  const nodes = isClosed(rim) ? rim.nodes.slice(1) : rim.nodes;
  if (nodes.length < 3) return undefined;
  const third = (k: number) =>
    nodes[Math.floor((k * (nodes.length - (isClosed(rim) ? 0 : 1))) / (isClosed(rim) ? 3 : 2))];
  const [a, b, c] = [0, 1, 2].map((k) => pointOf(points, third(k) ?? 0));
  if (a === undefined || b === undefined || c === undefined) return undefined;
  const [u, v] = [minus(b, a), minus(c, a)];
  const normal = cross(u, v);
  const squared = dot(normal, normal);
  if (!(squared > 1e-16 * dot(u, u) * dot(v, v))) return undefined;
  const towards = plus(scaled(cross(v, normal), -dot(u, u)), scaled(cross(u, normal), dot(v, v)));
  const offset = scaled(towards, -1 / (2 * squared));
  const circle = { centre: plus(a, offset), radius: lengthOf(offset), frame: frameOf(normal) };
  return isOnCircle(rim, circle, points, tolerance) ? circle : undefined;
}

function isOnCircle({ nodes }: Rim, circle: Circle, points: Float64Array, tolerance: number): boolean {
  return nodes.every((node) => distanceFromCircle(pointOf(points, node), circle) <= tolerance);
}

function distanceFromCircle(p: Vector, { centre, radius, frame }: Circle): number {
  const d = minus(p, centre);
  const height = dot(d, frame.axis);
  const across = lengthOf(minus(d, scaled(frame.axis, height))) - radius;
  return Math.sqrt(height * height + across * across);
}

interface Tolerance {
  readonly points: Float64Array;
  readonly tolerance: number;
}

/** Returns the rims on each circle. The longest rims, whose circles are the most accurate, come first. */
function* commonCircles(
  rims: readonly Rim[],
  circles: readonly (Circle | undefined)[],
  { points, tolerance }: Tolerance,
): Steps<Common[]> {
  const common: Common[] = [];
  const order = [...rims.keys()].filter((r) => circles[r] !== undefined);
  const lengthOfRim = (r: number) => rims[r]?.nodes.length ?? 0;
  order.sort((a, b) => lengthOfRim(b) - lengthOfRim(a) || a - b);
  const near = new CircleGrid(tolerance);
  for (const r of order) {
    const [rim, circle] = [rims[r], circles[r]];
    if (rim === undefined || circle === undefined) continue;
    const home = near.around(circle).find((c) => {
      const known = common[c]?.circle;
      return known !== undefined && isOnCircle(rim, known, points, tolerance);
    });
    if (home === undefined) {
      near.add(circle, common.length);
      common.push({ circle, rims: [r] });
    } else common[home]?.rims.push(r);
    yield PAUSE;
  }
  return common;
}

/** Finds circles of about the same centre and radius. A short arc knows its circle less well: the cells are large. */
class CircleGrid {
  readonly #cells = new Map<string, number[]>();
  readonly #size: number;

  constructor(tolerance: number) {
    this.#size = 1e4 * tolerance;
  }

  add(circle: Circle, index: number): void {
    for (const key of this.#keys(circle)) {
      const known = this.#cells.get(key);
      if (known === undefined) this.#cells.set(key, [index]);
      else known.push(index);
    }
  }

  around(circle: Circle): number[] {
    return this.#cells.get(this.#cellOf(circle).join()) ?? [];
  }

  #cellOf({ centre, radius }: Circle): number[] {
    return [...centre, radius].map((x) => Math.floor(x / this.#size));
  }

  /** Returns the cells next to that of a circle too. */
  #keys(circle: Circle): string[] {
    return this.#cellOf(circle)
      .reduce<number[][]>(
        (all, x) => all.flatMap((key) => [-1, 0, 1].map((step) => [...key, x + step])),
        [[]],
      )
      .map((key) => key.join());
  }
}

/** What the nodes of rims depend on. */
interface Unifying extends Tolerance {
  readonly found: FacesAndRims;
}

/** A rim on a circle: from where it goes in the direction of growing turns. */
interface Arc {
  readonly rim: Rim;
  /** Whether its nodes go in the direction of growing turns. */
  readonly isForward: boolean;
  /** Fixed nodes at its ends in that direction; undefined for a closed rim without one. */
  readonly from: number | undefined;
  readonly to: number | undefined;
  /** All its nodes in that direction. */
  readonly nodes: readonly number[];
}

/** Share of the mean length of edges by which nodes keep away from fixed ones. */
const CLEARANCE = 0.3;

function unifyCircle(circle: Circle, members: readonly number[], { found, points }: Unifying): void {
  const turn = (node: number): number => {
    const d = minus(pointOf(points, node), circle.centre);
    return turnOf(dot(d, circle.frame.x), dot(d, circle.frame.y));
  };
  const isFixed = fixedNodes(found, members);
  const arcs = members.flatMap((r) => {
    const rim = found.rims[r];
    return rim === undefined ? [] : arcsOf(rim, turn, isFixed);
  });
  const fixed = [...new Set(arcs.flatMap(({ nodes }) => nodes.filter((node) => isFixed.has(node))))];
  fixed.sort((a, b) => turn(a) - turn(b) || a - b);
  if (fixed.length === 0) return adoptRings(arcs);
  const pieces = fixed.map((from, i) => {
    const to = fixed[(i + 1) % fixed.length] ?? from;
    return { from, to, ...commonPiece(arcs, from, to, turn, fixed) };
  });
  rewrite(arcs, pieces, fixed);
}

/** Returns the nodes that must stay: ends of rims, and all nodes beside faces whose surface is not known. */
function fixedNodes({ rims, faces }: FacesAndRims, members: readonly number[]): Set<number> {
  const isFixed = new Set<number>();
  for (const r of members) {
    const rim = rims[r];
    if (rim === undefined) continue;
    const { nodes } = rim;
    if (rim.faces.some((f) => faces[f]?.surface === undefined)) for (const node of nodes) isFixed.add(node);
    else if (!isClosed(rim) || hasCorner(rims, rim, nodes[0] ?? 0, faces)) {
      isFixed.add(nodes[0] ?? 0).add(nodes.at(-1) ?? 0);
    }
  }
  return isFixed;
}

/** Returns whether another rim of the same shape ends at a node of a closed one. */
function hasCorner(rims: readonly Rim[], own: Rim, node: number, faces: FacesAndRims["faces"]): boolean {
  return own.faces.some((f) =>
    (faces[f]?.rims ?? []).some((r) => rims[r] !== own && rims[r]?.nodes.includes(node) === true),
  );
}

/** Divides a rim at its fixed nodes. */
function arcsOf(rim: Rim, turn: (node: number) => number, isFixed: ReadonlySet<number>): Arc[] {
  const [a = 0, b = 0] = rim.nodes;
  const step = (turn(b) - turn(a) + TURNS) % TURNS;
  const isForward = step < TURNS / 2;
  const nodes = isForward ? rim.nodes : rim.nodes.toReversed();
  const isRing = isClosed(rim) && !nodes.some((node) => isFixed.has(node));
  if (isRing) return [{ rim, isForward, from: undefined, to: undefined, nodes }];
  return [{ rim, isForward, from: nodes[0], to: nodes.at(-1), nodes }];
}

/** Gives the nodes of the finest closed curve to all of them. */
function adoptRings(arcs: readonly Arc[]): void {
  const finest = arcs.reduce((best, arc) => (arc.nodes.length > best.nodes.length ? arc : best));
  for (const { rim, isForward } of arcs) rim.nodes = isForward ? finest.nodes : finest.nodes.toReversed();
}

interface Piece {
  readonly from: number;
  readonly to: number;
  /** Nodes between, for all arcs that cover the piece; undefined if each keeps its own. */
  readonly inner: readonly number[] | undefined;
}

/** Returns the nodes between two consecutive fixed nodes: those of the finest arc. */
function commonPiece(
  arcs: readonly Arc[],
  from: number,
  to: number,
  turn: (node: number) => number,
  fixed: readonly number[],
): { readonly inner: readonly number[] | undefined } {
  const start = turn(from);
  const length = fixed.length === 1 ? TURNS : (turn(to) - start + TURNS) % TURNS;
  const offset = (node: number) => (turn(node) - start + TURNS) % TURNS;
  const covering = arcs.filter((arc) => covers(arc, from, length, turn));
  if (covering.length === 0) return { inner: undefined };
  const innerOf = ({ nodes }: Arc) => {
    const inside = [...new Set(nodes)].filter((node) => {
      const along = offset(node);
      return node !== from && node !== to && along > 0 && along < length;
    });
    return inside.sort((a, b) => offset(a) - offset(b));
  };
  const all = covering.map(innerOf);
  const finest = all.reduce((best, inner) => (inner.length > best.length ? inner : best));
  const clearance = (CLEARANCE * length) / (finest.length + 1);
  // Nodes of other arcs than those that end at both fixed nodes may be anywhere beside these.
  const kept = finest.filter((node) => offset(node) > clearance && length - offset(node) > clearance);
  return { inner: kept };
}

/** Returns whether an arc contains the piece that begins at a fixed node. */
function covers(arc: Arc, from: number, length: number, turn: (node: number) => number): boolean {
  if (arc.from === undefined || arc.to === undefined) return true;
  const sweep = arc.from === arc.to ? TURNS : (turn(arc.to) - turn(arc.from) + TURNS) % TURNS;
  const along = arc.from === from ? 0 : (turn(from) - turn(arc.from) + TURNS) % TURNS;
  return along + length <= sweep * (1 + 1e-9) + 1e-12;
}

function rewrite(arcs: readonly Arc[], pieces: readonly Piece[], fixed: readonly number[]): void {
  const pieceAt = new Map(pieces.map((piece, i) => [piece.from, i]));
  for (const { rim, isForward, from, to } of arcs) {
    const start = from ?? fixed[0] ?? 0;
    const end = to ?? start;
    const nodes = [start];
    for (
      let i = pieceAt.get(start) ?? 0, count = 0;
      count < pieces.length;
      count++, i = (i + 1) % pieces.length
    ) {
      const piece = pieces[i];
      if (piece === undefined) break;
      nodes.push(...(piece.inner ?? []), piece.to);
      if (piece.to === end) break;
    }
    rim.nodes = isForward ? nodes : nodes.toReversed();
  }
}

/** Share of the length of an edge by which the nodes of another curve may be beside it: the curve is not straight. */
const SAGITTA = 0.03;

/** Gives the same nodes to curves other than circles that begin and end at the same nodes and are nowhere apart. */
function unifyOthers(
  { rims, faces }: FacesAndRims,
  circles: readonly (Circle | undefined)[],
  points: Float64Array,
  tolerance: number,
): void {
  const known = new Map<number, Rim[]>();
  for (const [r, rim] of rims.entries()) {
    if (circles[r] !== undefined || rim.nodes.length < 3 || isClosed(rim)) continue;
    const [from = 0, to = 0] = [rim.nodes[0], rim.nodes.at(-1)];
    const key = pairKey(from, to);
    const others = known.get(key) ?? [];
    const isFree = rim.faces.every((f) => faces[f]?.surface !== undefined);
    const other = others.find(
      (one) =>
        one.shape !== rim.shape &&
        isAlong(rim, one, points, tolerance) &&
        isAlong(one, rim, points, tolerance),
    );
    if (other !== undefined && isFree)
      rim.nodes = other.nodes[0] === from ? other.nodes : other.nodes.toReversed();
    known.set(key, [...others, rim]);
  }
}

/** Returns whether the nodes of a curve are beside the edges of another one. */
function isAlong({ nodes }: Rim, { nodes: path }: Rim, points: Float64Array, tolerance: number): boolean {
  return nodes.every((node) => {
    const p = pointOf(points, node);
    return path.slice(1).some((to, i) => {
      const [a, b] = [pointOf(points, path[i] ?? 0), pointOf(points, to)];
      const [along, from] = [minus(b, a), minus(p, a)];
      const squared = dot(along, along);
      const share = Math.max(0, Math.min(1, squared > 0 ? dot(from, along) / squared : 0));
      return lengthOf(minus(from, scaled(along, share))) <= tolerance + SAGITTA * Math.sqrt(squared);
    });
  });
}
