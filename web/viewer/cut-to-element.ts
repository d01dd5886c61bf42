import type { VolumeMesh } from "tetrafront";
import type { Position } from "../document/position";
import type { Cut, CutAxis } from "../document/selection";
import { centroidsAlong, extentAlong } from "./queries/visible-faces";

const axes: readonly CutAxis[] = ["x", "y", "z"];
/** Share of the extent that a cut must leave: an element at the far side is shown with what lies beside it. */
const minRest = 0.02;

/**
 * Returns the cut that exposes an element to a viewer in the direction `toEye`: across the axis that points most at the
 * viewer, at the far end of the element. Nothing stays in front of the element, not even elements that touch it; the highlight
 * draws the element itself. O(nodes).
 */
export function cutToElement(mesh: VolumeMesh, element: number, toEye: Position): Cut {
  const towards = (axis: CutAxis): number => toEye[axes.indexOf(axis)] ?? 0;
  const axis = axes.reduce((best, other) =>
    Math.abs(towards(other)) > Math.abs(towards(best)) ? other : best,
  );
  const flipped = towards(axis) < 0;
  const [low, high] = extentAlong(mesh.points, axis);
  const share = (value: number): number => (high > low ? (value - low) / (high - low) : 0.5);
  const nodes = mesh.tetrahedra.subarray(4 * element, 4 * element + 4);
  const ends = [...nodes].map((node) => share(mesh.points[3 * node + axes.indexOf(axis)] ?? 0));
  const farEnd = flipped ? Math.max(...ends) : Math.min(...ends);
  const rest = flipped ? 1 - farEnd : farEnd;
  const [centroid = 0] = centroidsAlong({ points: mesh.points, tetrahedra: nodes }, axis);
  return { enabled: true, axis, flipped, position: rest < minRest ? share(centroid) : farEnd };
}
