/** Where a face of the front and a new element meet, for display: the engine decides by exact signs. */
import { Triangle as Corners, Vector3 } from "three";
import type { Position } from "../../document/position";
import { between } from "../../document/vectors";
import type { Triangle } from "./crossing";
import { weightsOf, type NewElement } from "./judge";

/**
 * Returns the part of a face that lies in an element: the corners of a convex polygon, in order; fewer than three if they only
 * touch, none if they are apart. It is clipped by the element's faces, one after the other (Sutherland & Hodgman 1974).
 */
export function partInElement(corners: NewElement["corners"], face: Triangle): readonly Position[] {
  let part: Weighted[] = face.map((position) => ({ position, weights: weightsOf(corners, position) }));
  for (let side = 0; side < 4; side++) part = clipped(part, side);
  return part.map(({ position }) => position);
}

/** A position, and the shape functions of the element there: one is negative beyond each of its faces. */
interface Weighted {
  readonly position: Position;
  readonly weights: readonly number[];
}

function clipped(polygon: readonly Weighted[], side: number): Weighted[] {
  return polygon.flatMap((from, i) => {
    const to = polygon[(i + 1) % polygon.length] ?? from;
    const [atFrom, atTo] = [from.weights[side] ?? 0, to.weights[side] ?? 0];
    const kept = atFrom >= 0 ? [from] : [];
    // The shape functions are linear along the edge.
    return atFrom >= 0 === atTo >= 0 ? kept : [...kept, weightedBetween(from, to, atFrom / (atFrom - atTo))];
  });
}

function weightedBetween(from: Weighted, to: Weighted, share: number): Weighted {
  return {
    position: between(from.position, to.position, share),
    weights: from.weights.map((weight, i) => weight + share * ((to.weights[i] ?? 0) - weight)),
  };
}

/** Returns the position on a face that is nearest to a position. */
export function nearestOnFace(face: Triangle, position: Position): Position {
  const [a, b, c] = face.map((corner) => new Vector3(...corner));
  if (!a || !b || !c) return position;
  const { x, y, z } = new Corners(a, b, c).closestPointToPoint(new Vector3(...position), new Vector3());
  return [x, y, z];
}
