/**
 * Facets of TetGen's files: rings of corners in one plane, nested rings, and points that mark holes. Each ring
 * becomes a polygon, connected to the rings directly inside it by bridges that are passed in both directions (D.
 * Eberly, "Triangulation by Ear Clipping").
 */
import type { Work } from "./chain-tree.js";
import { type ClippingBudget, doubledArea, flatView, type Position2, type Position3 } from "./polygons.js";
import type { Coordinates } from "./sixfold-volume.js";

/** Ring of a facet, counter-clockwise in the plane. */
interface Ring {
  readonly corners: readonly number[];
  readonly positions: readonly Position2[];
  /** Twice the area. */
  readonly area: number;
  /** Whether the file lists the corners in the opposite order. */
  readonly isReversed: boolean;
}

/**
 * Returns the polygons of a facet; each is oriented as its outermost ring in the file. Returns undefined if
 * they cannot be built safely: a ring has no area, rings intersect, a ring touches another one in all its
 * corners, or the work limit is reached.
 */
export function facetPolygons(
  rings: readonly (readonly number[])[],
  holes: readonly Position3[],
  points: Coordinates,
  budget: ClippingBudget,
): readonly (readonly number[])[] | undefined {
  if (rings.length === 1 && holes.length === 0) return rings;
  const corners = rings.reduce((sum, ring) => sum + ring.length, 0);
  return budget.spend(corners, (work) => nestedPolygons(rings, holes, points, work));
}

function nestedPolygons(
  given: readonly (readonly number[])[],
  holes: readonly Position3[],
  points: Coordinates,
  work: Work,
): (readonly number[])[] | undefined {
  const [first = []] = given;
  const view = flatView(first, points);
  const rings = given.map((corners) => ringOf(corners, points, view));
  if (rings.some(({ area }) => !(area > 0)) || anyCross(rings, work)) return undefined;
  const parents = rings.map((ring) => parentOf(ring, rings, work));
  work.left -= holes.length * given.reduce((sum, { length }) => sum + length, 0);
  if (work.left <= 0) return undefined;
  const isEmpty = new Set(holes.map((hole) => innermost(view(hole), rings)));
  const polygons: (readonly number[])[] = [];
  for (const [r, ring] of rings.entries()) {
    if (isEmpty.has(ring)) continue;
    const inner = rings.filter((_, other) => parents[other] === ring);
    const joined = withBridges(ring, inner, work);
    if (joined === undefined) return undefined;
    polygons.push(rootOf(r, rings, parents).isReversed ? joined.reverse() : joined);
  }
  return polygons;
}

function ringOf(
  corners: readonly number[],
  points: Coordinates,
  view: (position: Position3) => Position2,
): Ring {
  const positions = corners.map((c) =>
    view([points.at(3 * c) ?? 0, points.at(3 * c + 1) ?? 0, points.at(3 * c + 2) ?? 0]),
  );
  const [origin = [0, 0]] = positions;
  const area = positions.reduce((sum, position, i) => {
    const [x, y] = positions[(i + 1) % positions.length] ?? origin;
    return sum + (position[0] - origin[0]) * (y - origin[1]) - (x - origin[0]) * (position[1] - origin[1]);
  }, 0);
  if (area >= 0) return { corners, positions, area, isReversed: false };
  return { corners: corners.toReversed(), positions: positions.toReversed(), area: -area, isReversed: true };
}

function anyCross(rings: readonly Ring[], work: Work): boolean {
  return rings.some((one, r) =>
    rings.slice(r + 1).some((other) => {
      work.left -= one.positions.length * other.positions.length;
      if (work.left <= 0) return true;
      return one.positions.some((b, i) => {
        const a = one.positions.at(i - 1) ?? b;
        return other.positions.some((d, j) => doCross(a, b, other.positions.at(j - 1) ?? d, d));
      });
    }),
  );
}

/** Returns whether the segments ab and cd cross in the interior of both. */
function doCross(a: Position2, b: Position2, c: Position2, d: Position2): boolean {
  return doubledArea(a, b, c) * doubledArea(a, b, d) < 0 && doubledArea(c, d, a) * doubledArea(c, d, b) < 0;
}

/** Returns the smallest ring that contains this ring. */
function parentOf(ring: Ring, rings: readonly Ring[], work: Work): Ring | undefined {
  const around = rings.filter((other) => {
    if (other === ring || other.area <= ring.area) return false;
    for (const position of ring.positions) {
      work.left -= other.positions.length;
      const side = sideOf(position, other.positions);
      if (side !== 0) return side > 0;
    }
    return false;
  });
  return smallest(around);
}

function innermost(position: Position2, rings: readonly Ring[]): Ring | undefined {
  return smallest(rings.filter(({ positions }) => sideOf(position, positions) > 0));
}

function smallest(rings: readonly Ring[]): Ring | undefined {
  return rings.reduce<Ring | undefined>(
    (best, ring) => (best && best.area <= ring.area ? best : ring),
    undefined,
  );
}

/** Returns 1 inside a ring, -1 outside, 0 on it. */
function sideOf(position: Position2, ring: readonly Position2[]): -1 | 0 | 1 {
  let isWithin = false;
  for (const [i, b] of ring.entries()) {
    const a = ring.at(i - 1) ?? b;
    const [low, high] = a[1] <= b[1] ? [a, b] : [b, a];
    const side = doubledArea(low, high, position);
    const isBeside = position[1] >= low[1] && position[1] <= high[1];
    const isBelow = position[0] >= Math.min(a[0], b[0]) && position[0] <= Math.max(a[0], b[0]);
    if (side === 0 && isBeside && isBelow) return 0;
    if (position[1] >= low[1] && position[1] < high[1] && side > 0) isWithin = !isWithin;
  }
  return isWithin ? 1 : -1;
}

function rootOf(r: number, rings: readonly Ring[], parents: readonly (Ring | undefined)[]): Ring {
  for (let at = r; ;) {
    const parent = parents[at];
    if (parent === undefined) return rings[at] ?? EMPTY;
    at = rings.indexOf(parent);
  }
}

const EMPTY: Ring = { corners: [], positions: [], area: 0, isReversed: false };

/** Corner of the polygon under construction. */
interface Corner {
  readonly node: number;
  readonly position: Position2;
}

/** Returns the corners of the ring with a bridge to each inner ring; inner rings run in the opposite direction. */
function withBridges(outer: Ring, inner: readonly Ring[], work: Work): number[] | undefined {
  const cornersOf = ({ corners, positions }: Ring): Corner[] =>
    corners.map((node, i) => ({ node, position: positions[i] ?? [0, 0] }));
  let chain = cornersOf(outer);
  // Process the rings from right to left: only rings already connected or still waiting can obstruct a bridge.
  const left = inner.map((ring) => fromRight(cornersOf(ring).reverse()));
  left.sort((a, b) => (b[0]?.position[0] ?? 0) - (a[0]?.position[0] ?? 0));
  for (let ring = left.shift(); ring !== undefined; ring = left.shift()) {
    const begin = ring[0];
    const at = begin && bridgeFrom(begin.position, chain, [chain, ring, ...left], work);
    if (at === undefined) return undefined;
    const back = [...ring, ...ring.slice(0, 1), ...chain.slice(at, at + 1)];
    chain = [...chain.slice(0, at + 1), ...back, ...chain.slice(at + 1)];
  }
  return chain.map(({ node }) => node);
}

function fromRight(ring: readonly Corner[]): Corner[] {
  const rightmost = ring.reduce(
    (best, { position }, i) => (position[0] > (ring[best]?.position[0] ?? 0) ? i : best),
    0,
  );
  return [...ring.slice(rightmost), ...ring.slice(0, rightmost)];
}

/** Returns the index of the nearest corner of the chain that is visible from `from`; undefined if no corner is. */
function bridgeFrom(
  from: Position2,
  chain: readonly Corner[],
  obstacles: readonly (readonly Corner[])[],
  work: Work,
): number | undefined {
  const distance = ({ position }: Corner) => Math.hypot(position[0] - from[0], position[1] - from[1]);
  const order = chain
    .map((corner, i) => [distance(corner), i] as const)
    .sort(([a, i], [b, j]) => a - b || i - j);
  for (const [, i] of order) {
    work.left -= obstacles.reduce((sum, obstacle) => sum + obstacle.length, 0);
    if (work.left <= 0) return undefined;
    if (isVisible(from, chain, i, obstacles)) return i;
  }
  return undefined;
}

function isVisible(
  from: Position2,
  chain: readonly Corner[],
  i: number,
  obstacles: readonly (readonly Corner[])[],
): boolean {
  const positionAt = (corner: Corner | undefined): Position2 => corner?.position ?? from;
  const [before, to, after] = [
    positionAt(chain.at(i - 1)),
    positionAt(chain[i]),
    positionAt(chain[(i + 1) % chain.length]),
  ];
  const isConvex = doubledArea(before, to, after) >= 0;
  const [isLeft, isRight] = [doubledArea(before, to, from) > 0, doubledArea(to, after, from) > 0];
  if (!(isConvex ? isLeft && isRight : isLeft || isRight)) return false;
  return obstacles.every((obstacle) =>
    obstacle.every((corner, w) => {
      const [a, b] = [positionAt(obstacle.at(w - 1)), corner.position];
      if (doCross(from, to, a, b)) return false;
      // The bridge must not pass through a corner either.
      const isEnd = isSame(b, from) || isSame(b, to);
      return isEnd || doubledArea(from, to, b) !== 0 || !isWithinBox(b, from, to);
    }),
  );
}

function isSame(a: Position2, b: Position2): boolean {
  return a[0] === b[0] && a[1] === b[1];
}

function isWithinBox(p: Position2, a: Position2, b: Position2): boolean {
  return [0, 1].every((axis) => {
    const [x = 0, from = 0, to = 0] = [p[axis], a[axis], b[axis]];
    return x >= Math.min(from, to) && x <= Math.max(from, to);
  });
}
