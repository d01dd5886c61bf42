/** The node that the reader moves within a pocket, across the line of sight: turning the view gives the other directions. */
import type { Position } from "../../../../document/position";
import { clamp } from "../../kit/motion";
import type { Camera } from "../../kit/space";
import type { HandleOptions } from "../../kit/stage";

export interface MovedNode {
  readonly at: () => Position;
  readonly moveTo: (position: Position) => void;
  readonly begin: () => void;
  readonly describe: () => string;
}

/** Returns a handle whose position stays within a box. */
export function nodeHandle(
  camera: Camera,
  [low, high]: readonly [Position, Position],
  { at, moveTo, begin, describe }: MovedNode,
): HandleOptions {
  return {
    name: "node",
    label: "Node in the pocket: arrow keys move it across the view",
    look: "new solid",
    at: () => camera.pixel(at()),
    begin,
    move: (pixel) => {
      const hit = camera.onPlane(pixel, at(), camera.axes[2]);
      if (hit) moveTo(hit.map((x, i) => clamp(x, low[i] ?? 0, high[i] ?? 0)) as unknown as Position);
    },
    describe,
  };
}
