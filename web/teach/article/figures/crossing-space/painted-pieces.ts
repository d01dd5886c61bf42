/** Two triangles in the order in which they are painted: each is cut along the plane of the other, and the far pieces come first. */
import type { Position } from "../../../../document/position";
import { between, cross, dot, subtract } from "../../../../document/vectors";
import type { Triangle } from "../../../player/crossing";

export interface PaintedPiece {
  readonly corners: readonly Position[];
  /** Per corner, the side of its triangle on which the edge to the next corner lies; null along the cut. */
  readonly sides: readonly (number | null)[];
  /** Whether it belongs to the first triangle. */
  readonly isFirst: boolean;
}

/**
 * Returns the pieces from far to near, as seen from the eye. The first triangle is painted between the pieces of the second one:
 * those on the far side of its plane before it, the others after it.
 */
export function paintedPieces(first: Triangle, second: Triangle, eye: Position): readonly PaintedPiece[] {
  const normal = cross(subtract(first[1], first[0]), subtract(first[2], first[0]));
  const side = (point: Position): number => dot(subtract(point, first[0]), normal);
  const towards = Math.sign(side(eye)) || 1;
  const near = clip(whole(second), (point) => side(point) * towards);
  const far = clip(whole(second), (point) => -side(point) * towards);
  const piece = (corners: readonly Corner[], isFirst: boolean): readonly PaintedPiece[] =>
    corners.length < 3
      ? []
      : [{ corners: corners.map(({ at }) => at), sides: corners.map((corner) => corner.side), isFirst }];
  return [...piece(far, false), ...piece(whole(first), true), ...piece(near, false)];
}

interface Corner {
  readonly at: Position;
  readonly side: number | null;
}

const whole = (triangle: Triangle): readonly Corner[] => triangle.map((at, side) => ({ at, side }));

/** Returns the part of a polygon where `height` is positive. */
function clip(polygon: readonly Corner[], height: (point: Position) => number): readonly Corner[] {
  return polygon.flatMap((from, i) => {
    const to = polygon[(i + 1) % polygon.length] ?? from;
    const [h, k] = [height(from.at), height(to.at)];
    const kept = h >= 0 ? [from] : [];
    if (h * k >= 0) return kept;
    return [...kept, { at: between(from.at, to.at, h / (h - k)), side: h >= 0 ? null : from.side }];
  });
}
