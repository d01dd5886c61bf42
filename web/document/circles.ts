import type { Position } from "./position";
import { add, addScaled, cross, dot, scale, subtract } from "./vectors";

/** Returns a position turned around an axis of length 1 through a centre, counter-clockwise, by a number of turns. */
export function turned(position: Position, centre: Position, axis: Position, turns: number): Position {
  const arm = subtract(position, centre);
  const along = scale(axis, dot(arm, axis));
  const across = subtract(arm, along);
  const angle = 2 * Math.PI * turns;
  const rotated = addScaled(scale(across, Math.cos(angle)), cross(axis, across), Math.sin(angle));
  return add(centre, add(along, rotated));
}
