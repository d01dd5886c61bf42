/** Triangles of the plane and tetrahedra of space, with one code for both: which lie the right way round, overlap, and have which angles. */
import type { Position } from "../../../../document/position";
import { addScaled, cross, distance, dot, length, subtract, unit } from "../../../../document/vectors";

/** Corners of an element or of a facet: a facet has 2 in the plane and 3 in space, an element one more. */
export type Corners = readonly Position[];

/** What is nearer than this share of the facet counts as touching. */
const tolerance = 1e-7;
const up: Position = [0, 0, 1];
const degrees = 180 / Math.PI;

/** Returns the direction into the empty side of a facet; its length is the size of the facet, in space twice its area. */
export function normalOf([a, b, c]: Corners): Position {
  if (!a || !b) return up;
  return c ? cross(subtract(b, a), subtract(c, a)) : cross(up, subtract(b, a));
}

/** Returns the height of a point over a facet, as a share of the facet's longest side. */
export function heightOver(facet: Corners, apex: Position): number {
  const [base = up] = facet;
  const towards = unit(normalOf(facet)) ?? up;
  return dot(subtract(apex, base), towards) / longestSide(facet);
}

export const longestSide = (corners: Corners): number =>
  Math.max(...sidesOf(corners).map(([a, b]) => distance(a, b)));

/** Returns the facets of an element over a facet, except this one, with the empty side as in `normalOf`. Generic over nodes and positions. */
export function newFacets<Corner>(facet: readonly Corner[], apex: Corner): readonly (readonly Corner[])[] {
  const [a, b, c] = facet as readonly [Corner, Corner, Corner?];
  if (c === undefined)
    return [
      [a, apex],
      [apex, b],
    ];
  return [
    [a, b, apex],
    [b, c, apex],
    [c, a, apex],
  ];
}

/** Returns whether an element and a facet have more in common than what both have on their boundary. O(1). */
export function overlaps(element: Corners, facet: Corners): boolean {
  return !axesBetween(element, facet).some((axis) => isSeparating(axis, element, facet));
}

/** Directions among which there is one that separates two convex bodies, if any does (the theorem of the separating axis). */
function axesBetween(element: Corners, facet: Corners): readonly Position[] {
  const along = (corners: Corners): readonly Position[] => sidesOf(corners).map(([a, b]) => subtract(b, a));
  const [of, other] = [along(element), along(facet)];
  if (element.length === 3) return [...of, ...other].map((side) => cross(side, up));
  const faces = [facet, ...element.map((_corner, i) => element.filter((_each, k) => k !== i))];
  return [...faces.map(normalOf), ...of.flatMap((side) => other.map((each) => cross(side, each)))];
}

function isSeparating(axis: Position, element: Corners, facet: Corners): boolean {
  const size = length(axis);
  if (size === 0) return false;
  const onAxis = (corners: Corners): readonly number[] => corners.map((corner) => dot(axis, corner) / size);
  const [one, two] = [onAxis(element), onAxis(facet)];
  const touching = tolerance * longestSide(element);
  return Math.max(...one) <= Math.min(...two) + touching || Math.max(...two) <= Math.min(...one) + touching;
}

/** Returns whether a point lies in an element or on its boundary. */
export function contains(element: Corners, point: Position): boolean {
  return element.every((corner, i) => {
    const facet = element.filter((_each, k) => k !== i);
    const normal = unit(normalOf(facet)) ?? up;
    const [base = up] = facet;
    const inward = dot(subtract(corner, base), normal) >= 0 ? 1 : -1;
    return inward * dot(subtract(point, base), normal) >= -tolerance * longestSide(element);
  });
}

/** Returns the distance between two segments. */
export function gapBetween(
  [a, b]: readonly [Position, Position],
  [c, d]: readonly [Position, Position],
): number {
  const [u, v, w] = [subtract(b, a), subtract(d, c), subtract(a, c)];
  const [uu, uv, vv, uw, vw] = [dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)];
  const area = uu * vv - uv * uv;
  const within = (t: number): number => Math.min(1, Math.max(0, t));
  const s = area > 1e-12 * uu * vv ? within((uv * vw - vv * uw) / area) : 0;
  const t = within((uv * s + vw) / vv);
  const nearest = within((uv * t - uw) / uu);
  return distance(addScaled(a, u, nearest), addScaled(c, v, t));
}

/** Returns the sides between corners: three of a triangle, six of a tetrahedron. */
export const sidesOf = <Corner>(corners: readonly Corner[]): readonly (readonly [Corner, Corner])[] =>
  corners.flatMap((a, i) => corners.slice(i + 1).map((b) => [a, b] as const));

/** Returns the smallest angle of a triangle, or the smallest angle between two faces of a tetrahedron, in degrees. */
export function smallestAngleOf(element: Corners): number {
  const angles = element.flatMap((corner, i) => {
    const others = element.filter((_each, k) => k !== i);
    if (others.length === 2)
      return [angleBetween(subtract(others[0] ?? up, corner), subtract(others[1] ?? up, corner))];
    return element.slice(i + 1).map((end) => {
      const along = unit(subtract(end, corner)) ?? up;
      const [p, q] = element
        .filter((each) => each !== corner && each !== end)
        .map((each) => across(subtract(each, corner), along));
      return angleBetween(p ?? up, q ?? up);
    });
  });
  return Math.min(...angles);
}

const across = (vector: Position, along: Position): Position => addScaled(vector, along, -dot(vector, along));

const angleBetween = (u: Position, v: Position): number =>
  Math.atan2(length(cross(u, v)), dot(u, v)) * degrees;
