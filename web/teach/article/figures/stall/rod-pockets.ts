/** Pockets at which a front has stalled: of the rod of needles, as the engine records them. */
import type { Position } from "../../../../document/position";
import type { Element, Face, Pocket } from "../pocket/pocket-rules";
import recorded from "./rod-pockets.json";

export interface RodPocket {
  /** In the coordinates of the rod: its axis is z, from 0 to 8, its radius 1. */
  readonly pocket: Pocket;
  /** The node of its star; null if it was filled in another way. */
  readonly node: Position | null;
  /** Corners of the pocket, then the new nodes. */
  readonly positions: readonly Position[];
  readonly elements: readonly Element[];
}

export const rodPockets: readonly RodPocket[] = recorded.map(({ change, ...each }) => {
  const positions = each.positions as unknown as readonly Position[];
  const faces = each.faces as unknown as readonly Face[];
  const count = 1 + Math.max(...faces.flat());
  return {
    pocket: { corners: positions.slice(0, count), faces },
    node: change === "star" ? (positions[count] ?? null) : null,
    positions,
    elements: each.elements as unknown as readonly Element[],
  };
});
