/** Two triangles in the order in which they are painted: each is cut along the plane of the other, and the far pieces come first. */
import type { Position } from "../../../../document/position";
import { between, cross, dot, subtract } from "../../../../document/vectors";
import type { Triangle } from "../../../player/crossing";

export interface PaintedPiece {
  readonly corners: readonly Position[];
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
  const near = clip(second, (point) => side(point) * towards);
  const far = clip(second, (point) => -side(point) * towards);
  const piece = (corners: readonly Position[], isFirst: boolean): readonly PaintedPiece[] =>
    corners.length < 3 ? [] : [{ corners, isFirst }];
  return [...piece(far, false), ...piece(first, true), ...piece(near, false)];
}

/** Returns the part of a polygon where `height` is positive. */
function clip(polygon: readonly Position[], height: (point: Position) => number): readonly Position[] {
  return polygon.flatMap((from, i) => {
    const to = polygon[(i + 1) % polygon.length] as Position;
    const [h, k] = [height(from), height(to)];
    const kept = h >= 0 ? [from] : [];
    return h * k < 0 ? [...kept, between(from, to, h / (h - k))] : kept;
  });
}
