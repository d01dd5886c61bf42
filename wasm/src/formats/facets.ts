/**
 * Facets of TetGen's files: rings of corners in one plane, rings within rings, and points that mark what is left out.
 * They become polygons, each ring joined with those right within it by bridges there and back (as in D. Eberly,
 * "Triangulation by Ear Clipping").
 */
import type { Work } from "./chain-tree.js";
import { flatView, turn, type ClippingBudget, type Place, type Triple } from "./polygons.js";
import type { Coordinates } from "./sixfold-volume.js";

/** A ring of a facet, counter-clockwise in the plane. */
interface Ring {
  readonly corners: readonly number[];
  readonly places: readonly Place[];
  /** Twice. */
  readonly area: number;
  /** Whether the file has it the other way round. */
  readonly isTurned: boolean;
}

/**
 * The polygons of a facet, turned as its rings are, those within others as these. Undefined where that cannot be done
 * safely: a ring has no area, rings cross or have all their corners on each other, or it takes more work than is allowed.
 */
export function facetPolygons(
  rings: readonly (readonly number[])[],
  holes: readonly Triple[],
  points: Coordinates,
  budget: ClippingBudget,
): readonly (readonly number[])[] | undefined {
  if (rings.length === 1 && holes.length === 0) return rings;
  const corners = rings.reduce((sum, ring) => sum + ring.length, 0);
  return budget.spend(corners, (work) => nestedPolygons(rings, holes, points, work));
}

function nestedPolygons(
  given: readonly (readonly number[])[],
  holes: readonly Triple[],
  points: Coordinates,
  work: Work,
): (readonly number[])[] | undefined {
  const [first = []] = given;
  const view = flatView(first, points);
  const rings = given.map((corners) => ringOf(corners, points, view));
  if (rings.some(({ area }) => !(area > 0)) || crossEachOther(rings, work)) return undefined;
  const parents = rings.map((ring) => parentOf(ring, rings, work));
  work.left -= holes.length * given.reduce((sum, { length }) => sum + length, 0);
  if (work.left <= 0) return undefined;
  const isEmpty = new Set(holes.map((hole) => innermost(view(hole), rings)));
  const polygons: (readonly number[])[] = [];
  for (const [r, ring] of rings.entries()) {
    if (isEmpty.has(ring)) continue;
    const within = rings.filter((_, other) => parents[other] === ring);
    const joined = withBridges(ring, within, work);
    if (joined === undefined) return undefined;
    polygons.push(rootOf(r, rings, parents).isTurned ? joined.reverse() : joined);
  }
  return polygons;
}

function ringOf(corners: readonly number[], points: Coordinates, view: (place: Triple) => Place): Ring {
  const places = corners.map((c) =>
    view([points.at(3 * c) ?? 0, points.at(3 * c + 1) ?? 0, points.at(3 * c + 2) ?? 0]),
  );
  const [origin = [0, 0]] = places;
  const area = places.reduce((sum, place, i) => {
    const [x, y] = places[(i + 1) % places.length] ?? origin;
    return sum + (place[0] - origin[0]) * (y - origin[1]) - (x - origin[0]) * (place[1] - origin[1]);
  }, 0);
  if (area >= 0) return { corners, places, area, isTurned: false };
  return { corners: corners.toReversed(), places: places.toReversed(), area: -area, isTurned: true };
}

function crossEachOther(rings: readonly Ring[], work: Work): boolean {
  return rings.some((one, r) =>
    rings.slice(r + 1).some((other) => {
      work.left -= one.places.length * other.places.length;
      if (work.left <= 0) return true;
      return one.places.some((b, i) => {
        const a = one.places.at(i - 1) ?? b;
        return other.places.some((d, j) => isCrossed(a, b, other.places.at(j - 1) ?? d, d));
      });
    }),
  );
}

/** Within both. */
function isCrossed(a: Place, b: Place, c: Place, d: Place): boolean {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/** The smallest ring around this one. */
function parentOf(ring: Ring, rings: readonly Ring[], work: Work): Ring | undefined {
  const around = rings.filter((other) => {
    if (other === ring || other.area <= ring.area) return false;
    for (const place of ring.places) {
      work.left -= other.places.length;
      const side = sideOf(place, other.places);
      if (side !== 0) return side > 0;
    }
    return false;
  });
  return smallest(around);
}

function innermost(place: Place, rings: readonly Ring[]): Ring | undefined {
  return smallest(rings.filter(({ places }) => sideOf(place, places) > 0));
}

function smallest(rings: readonly Ring[]): Ring | undefined {
  return rings.reduce<Ring | undefined>(
    (least, ring) => (least && least.area <= ring.area ? least : ring),
    undefined,
  );
}

/** 1 within a ring, -1 outside, 0 on it. */
function sideOf(place: Place, ring: readonly Place[]): -1 | 0 | 1 {
  let isWithin = false;
  for (const [i, b] of ring.entries()) {
    const a = ring.at(i - 1) ?? b;
    const [low, high] = a[1] <= b[1] ? [a, b] : [b, a];
    const side = turn(low, high, place);
    const isBeside = place[1] >= low[1] && place[1] <= high[1];
    const isBelow = place[0] >= Math.min(a[0], b[0]) && place[0] <= Math.max(a[0], b[0]);
    if (side === 0 && isBeside && isBelow) return 0;
    if (place[1] >= low[1] && place[1] < high[1] && side > 0) isWithin = !isWithin;
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

const EMPTY: Ring = { corners: [], places: [], area: 0, isTurned: false };

/** A corner of the polygon that is made. */
interface Corner {
  readonly node: number;
  readonly place: Place;
}

/** The corners of the ring with a bridge to each of those within it, which are walked the other way round. */
function withBridges(outer: Ring, within: readonly Ring[], work: Work): number[] | undefined {
  const cornersOf = ({ corners, places }: Ring): Corner[] =>
    corners.map((node, i) => ({ node, place: places[i] ?? [0, 0] }));
  let chain = cornersOf(outer);
  // From the right: nothing is in the way of the first bridge but what is joined already or still to come.
  const left = within.map((ring) => fromRight(cornersOf(ring).reverse()));
  left.sort((a, b) => (b[0]?.place[0] ?? 0) - (a[0]?.place[0] ?? 0));
  for (let inner = left.shift(); inner !== undefined; inner = left.shift()) {
    const begin = inner[0];
    const at = begin && bridgeFrom(begin.place, chain, [chain, inner, ...left], work);
    if (at === undefined) return undefined;
    const back = [...inner, ...inner.slice(0, 1), ...chain.slice(at, at + 1)];
    chain = [...chain.slice(0, at + 1), ...back, ...chain.slice(at + 1)];
  }
  return chain.map(({ node }) => node);
}

function fromRight(ring: readonly Corner[]): Corner[] {
  const most = ring.reduce((best, { place }, i) => (place[0] > (ring[best]?.place[0] ?? 0) ? i : best), 0);
  return [...ring.slice(most), ...ring.slice(0, most)];
}

/** The nearest corner of the chain that is seen from this place within the chain; undefined where none is. */
function bridgeFrom(
  from: Place,
  chain: readonly Corner[],
  walls: readonly (readonly Corner[])[],
  work: Work,
): number | undefined {
  const distance = ({ place }: Corner) => Math.hypot(place[0] - from[0], place[1] - from[1]);
  const order = chain
    .map((corner, i) => [distance(corner), i] as const)
    .sort(([a, i], [b, j]) => a - b || i - j);
  for (const [, i] of order) {
    work.left -= walls.reduce((sum, wall) => sum + wall.length, 0);
    if (work.left <= 0) return undefined;
    if (isSeen(from, chain, i, walls)) return i;
  }
  return undefined;
}

function isSeen(
  from: Place,
  chain: readonly Corner[],
  i: number,
  walls: readonly (readonly Corner[])[],
): boolean {
  const placeAt = (corner: Corner | undefined): Place => corner?.place ?? from;
  const [before, to, after] = [
    placeAt(chain.at(i - 1)),
    placeAt(chain[i]),
    placeAt(chain[(i + 1) % chain.length]),
  ];
  const isConvex = turn(before, to, after) >= 0;
  const [isLeft, isRight] = [turn(before, to, from) > 0, turn(to, after, from) > 0];
  if (!(isConvex ? isLeft && isRight : isLeft || isRight)) return false;
  return walls.every((wall) =>
    wall.every((corner, w) => {
      const [a, b] = [placeAt(wall.at(w - 1)), corner.place];
      if (isCrossed(from, to, a, b)) return false;
      // Nor may it pass through a corner.
      const isEnd = isSame(b, from) || isSame(b, to);
      return isEnd || turn(from, to, b) !== 0 || !isWithinBox(b, from, to);
    }),
  );
}

function isSame(a: Place, b: Place): boolean {
  return a[0] === b[0] && a[1] === b[1];
}

function isWithinBox(p: Place, a: Place, b: Place): boolean {
  return [0, 1].every((axis) => {
    const [x = 0, from = 0, to = 0] = [p[axis], a[axis], b[axis]];
    return x >= Math.min(from, to) && x <= Math.max(from, to);
  });
}
