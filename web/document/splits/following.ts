import type { Project, ProjectLine } from "tetrafront/project";
import { coordinatesOf } from "../expression-edits";
import { runsThroughMany } from "../line-types";
import type { Position } from "../position";
import {
  addQuantities,
  formulaTexts,
  quantityPosition,
  scaleQuantities,
  storableTexts,
  subtractQuantities,
  valuesOf,
  type QuantityPosition,
} from "../quantity-positions";
import { cross, dot, subtract } from "../vectors";

/**
 * Returns the expressions with which positions on a line follow those of its points. Returns none for splines, if no point
 * has any, and if one of them would be too long for the file.
 */
export function expressionsOnLine(
  project: Project,
  { type, points }: ProjectLine,
  linePoints: readonly Position[],
  positions: readonly Position[],
): readonly (readonly (string | null)[])[] {
  if (runsThroughMany(type) || !project.expressions) return [];
  const corners = points
    .slice(0, 3)
    .map((id, i) => quantityPosition(linePoints[i] ?? [0, 0, 0], coordinatesOf(project, id)));
  const texts = storableTexts(positions.map((position) => combined(corners, position)));
  return texts?.some((three) => three.some((text) => text !== null)) ? texts : [];
}

/** Returns a position in the plane, or on the line, of three or two positions as a combination of them. */
function combined(corners: readonly QuantityPosition[], position: Position): QuantityPosition {
  // The first corner occurs several times in the texts: with the shortest one, they stay short after many splits.
  const [a, b, c] = corners.toSorted((one, other) => textLength(one) - textLength(other));
  if (!a || !b) return position;
  const arm = subtract(position, valuesOf(a));
  const u = subtract(valuesOf(b), valuesOf(a));
  const along = (share: number, to: QuantityPosition) => scaleQuantities(subtractQuantities(to, a), share);
  const v = c && subtract(valuesOf(c), valuesOf(a));
  const normal = v && cross(u, v);
  const square = normal ? dot(normal, normal) : 0;
  if (!c || !v || !normal || square <= 1e-18 * dot(u, u) * dot(v, v)) {
    return addQuantities(a, along(dot(arm, u) / dot(u, u), b));
  }
  const [s, t] = [dot(cross(arm, v), normal) / square, dot(cross(u, arm), normal) / square];
  return addQuantities(addQuantities(a, along(s, b)), along(t, c));
}

const textLength = (position: QuantityPosition): number =>
  formulaTexts(position).reduce((sum, text) => sum + (text ?? "").length, 0);
