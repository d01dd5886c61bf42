import type { Position } from "../position";
import { turn } from "../vectors";

/** Returns the point of a circle around the z axis at a share of a full turn from the x axis, at a height z. */
export function onCircle(radius: number, share: number, z: number): Position {
  const [cosine, sine] = turn(share);
  return [radius * cosine, radius * sine, z];
}
