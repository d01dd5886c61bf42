import type { Position } from "../../document/position";
import { subtract } from "../../document/vectors";
import { roundTo } from "../../document/work-plane";
import type { Glyph } from "../../viewer/layers/size-glyph-layer";

/** A place in the view that the user can drag. */
export interface Grip {
  readonly position: Position;
  /** A line leads from here to the grip. */
  readonly from: Position;
  /** Where it moves: along a direction, parallel to the view, or parallel to the work plane. */
  readonly moves: Position | "view" | "work-plane";
  /** What it changes, with the present value: "Size 0.2". */
  readonly label: string;
}

/** A drag of a grip. */
export interface GripDrag {
  /** `step`: that of the coordinates and lengths; 0 for any. */
  moveTo(position: Position, step: number): void;
  commit(): void;
  cancel(): void;
}

/** The grips of what is selected or made, as they are drawn. */
export interface Grips {
  readonly glyphs: readonly Glyph[];
  readonly grips: readonly Grip[];
  /** Begins the drag of a grip; null if nothing can be changed now. */
  begin(index: number): GripDrag | null;
}

/** Rounds the coordinates of a position that have changed since `from`. */
export function onGrid(to: Position, from: Position, step: number): Position {
  if (step === 0) return to;
  const moved = subtract(to, from);
  return to.map((x, k) => (Math.abs(moved[k] ?? 0) < step / 2 ? (from[k] ?? 0) : roundTo(x, step))) as [
    number,
    number,
    number,
  ];
}
