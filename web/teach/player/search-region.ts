/**
 * Where the engine looks for the fourth node of an element (step F5.2): within some element sizes of the ideal point, in the
 * space where the target element is regular. Without stretching this is a ball, else an ellipsoid. Apexes of narrow gaps
 * between the base face and a neighbour are candidates also outside of it.
 */
import type { AdvanceStep, Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { add, addScaled, scale } from "../../document/vectors";
import { idealNumbers, unitAxes, type Axes } from "./unit-space";

/** Radius per rule class, in element sizes (cpp/src/volume/rules.h). */
const radii = [0.9, 2, 3, 5, 8] as const;

/** Segments of each drawn circle. */
const segmentCount = 48;

/** All positions `centre` + u₁ `axes[0]` + u₂ `axes[1]` + u₃ `axes[2]` with |u| at most `radius`. */
export interface SearchRegion {
  readonly centre: Position;
  readonly axes: Axes;
  /** In units of `axes`: of the model without stretching, else in target edge lengths. */
  readonly radius: number;
}

export function searchRegionOf(trace: Trace, step: AdvanceStep): SearchRegion {
  const axes = unitAxes(step);
  const { size } = idealNumbers(trace, step);
  return { centre: step.idealPoint, axes, radius: (radii[step.ruleClass] ?? radii[0]) * size };
}

/** Returns three circles around a region, as the ends of segments, two after two. */
export function outlineOf({ centre, axes, radius }: SearchRegion): Position[] {
  const circles = [
    [axes[0], axes[1]],
    [axes[1], axes[2]],
    [axes[2], axes[0]],
  ] as const;
  return circles.flatMap(([first, second]) => {
    const at = (i: number): Position => {
      const angle = (2 * Math.PI * i) / segmentCount;
      const arm = add(scale(first, Math.cos(angle)), scale(second, Math.sin(angle)));
      return addScaled(centre, arm, radius);
    };
    return Array.from({ length: segmentCount }, (_, i) => [at(i), at(i + 1)]).flat();
  });
}
