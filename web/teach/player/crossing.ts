/**
 * The paper's test whether a side crosses a face (Löhner & Parikh 1988, section 6, equations 1 to 5), in doubles and for
 * display: the engine decides by exact signs. The inequalities (5) and (6) are printed the wrong way round; here a side
 * crosses a face if no αⁱ is outside its interval by more than the tolerance.
 */
import type { Position } from "../../document/position";
import { cross, dot, subtract } from "../../document/vectors";

export type Triangle = readonly [Position, Position, Position];
export type Segment = readonly [Position, Position];

/** α¹ and α² are coordinates in the face, α³ along the side, α⁴ = 1 − α¹ − α². */
export type Alphas = readonly [number, number, number, number];

/** Returns the α of a side and a face; null if they are parallel. */
export function alphasOf([xs, end]: Segment, [xf, second, third]: Triangle): Alphas | null {
  const [g1, g2, g3] = [subtract(second, xf), subtract(third, xf), subtract(end, xs)];
  const normal = cross(g1, g2);
  const volume = dot(normal, g3);
  if (volume === 0) return null;
  // The contravariant basis is (g2 × g3, g3 × g1, g1 × g2) / volume.
  const toSide = subtract(xs, xf);
  const first = dot(toSide, cross(g2, g3)) / volume;
  const other = dot(toSide, cross(g3, g1)) / volume;
  const along = -dot(toSide, normal) / volume;
  return [first, other, along, 1 - first - other];
}

/** Returns by how much the α is outside the interval from 0 to 1 that is outside most: max (−αⁱ, αⁱ − 1). */
export function excessOf(alphas: Alphas): number {
  return Math.max(...alphas.map((alpha) => Math.max(-alpha, alpha - 1)));
}

/** A side of one triangle against another triangle: of the new element and of the front, or the other way round. */
export interface SideAndFace {
  /** Whether the side is one of the new element's, and the face one of the front's. */
  readonly isNewSide: boolean;
  readonly side: Segment;
  /** The nodes at the side's ends; null for a new node. */
  readonly ends: readonly [number | null, number | null];
  readonly face: Triangle;
  readonly alphas: Alphas;
  /** Not above the tolerance: the side crosses the face. */
  readonly excess: number;
  /** Where the side meets the plane of the face. */
  readonly point: Position;
}

/** Returns where a side is at α³. */
export function pointAt([from, to]: Segment, along: number): Position {
  const [dx, dy, dz] = subtract(to, from);
  return [from[0] + along * dx, from[1] + along * dy, from[2] + along * dz];
}
