import type { Project } from "tetrafront/project";
import type { Entity } from "../entities";
import { orderLoops } from "../loops";
import { patchMisfit, likelyPatchType, liesInPlane } from "../patch-rules";
import { loopsKey } from "../line-courses";
import { expressionFinder } from "../expression-edits";
import { quantityPosition, type QuantityPosition } from "../quantity-positions";
import type { Shape } from "../shape";
import { selectedParts, shapeOf } from "./selected-parts";

/** What is swept: patches, and lines beside them. */
export interface Profile {
  /** All points, lines and patches of the profile; a closed plane loop without a patch has one of its own. */
  readonly shape: Shape;
  /** The coordinates of its points, with the expressions from which they are computed. */
  readonly quantities: readonly QuantityPosition[];
  /** Numbers of the lines that sides are made of: those of exactly one patch, and those of none. */
  readonly outline: readonly number[];
  /** Ids of the selected patches. */
  readonly patchIds: readonly number[];
}

/** Returns the profile of the selected patches and lines; undefined if nothing of it is selected. */
export function profileOf(project: Project, selection: readonly Entity[]): Profile | undefined {
  const chosen = selection.filter(({ kind }) => kind === "patch" || kind === "line");
  const parts = selectedParts(project, chosen);
  if (parts.lines.length === 0) return undefined;
  const shape = shapeOf(parts);
  const uses = new Map<number, number>();
  for (const step of shape.patches.flatMap(({ loops }) => loops.flat())) {
    uses.set(Math.abs(step), (uses.get(Math.abs(step)) ?? 0) + 1);
  }
  const outline = shape.lines.map((_, index) => index + 1).filter((line) => (uses.get(line) ?? 0) <= 1);
  const loose = parts.lines.filter((_, index) => !uses.has(index + 1)).map(({ id }) => id);
  const caps = capOf(project, loose).map(({ type, loops }) => ({
    type,
    loops: loops.map((loop) =>
      loop.map((step) => Math.sign(step) * (parts.lines.findIndex(({ id }) => id === Math.abs(step)) + 1)),
    ),
  }));
  const textOf = expressionFinder(project);
  const quantities = parts.points.map(({ id, position }) =>
    quantityPosition(
      position,
      [0, 1, 2].map((axis) => textOf({ kind: "point", id, field: `position.${axis}` })),
    ),
  );
  return {
    shape: { ...shape, patches: [...shape.patches, ...caps] },
    quantities,
    outline,
    patchIds: parts.patches.map(({ id }) => id),
  };
}

/** Returns the patch within lines that form closed loops, if they lie in a plane or fit a type; else none. */
function capOf(project: Project, lines: readonly number[]) {
  const found = orderLoops(project, lines);
  if (!found.success) return [];
  const { loops } = found;
  const key = loopsKey(loops);
  const known = project.patches.find((patch) => loopsKey(patch.loops) === key);
  if (known) return [known];
  const type = likelyPatchType(project, loops);
  const fits = type !== "planar" || liesInPlane(project, loops);
  return fits && patchMisfit(project, type, loops) === null ? [{ type, loops }] : [];
}
