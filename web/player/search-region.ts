/**
 * Where the engine looks for the fourth node of an element (step F5.2): within some element sizes of the ideal point, in the
 * space where the target element is regular. Without stretching this is a ball, else an ellipsoid. Apexes of narrow gaps
 * between the base face and a neighbour are candidates also outside of it.
 */
import type { AdvanceStep, Trace } from "tetrafront";
import type { Position } from "../document/position";
import { add, addScaled, cross, dot, scale, subtract } from "../document/vectors";
import { cornersOf } from "./judge";

/** Radius per rule class, in element sizes (cpp/src/volume/rules.h, as are the next three). */
const radii = [0.9, 2, 3, 5, 8] as const;
const edgePerTarget = 0.97;
/** Limits of the element size, in sizes of the base face. */
const minSizePerBase = 0.55;
const maxSizePerBase = 2;

/** Segments of each drawn circle. */
const segmentCount = 48;

/** All positions `centre` + u₁ `axes[0]` + u₂ `axes[1]` + u₃ `axes[2]` with |u| at most `radius`. */
export interface SearchRegion {
  readonly centre: Position;
  readonly axes: readonly [Position, Position, Position];
  /** In units of `axes`: of the model without stretching, else in target edge lengths. */
  readonly radius: number;
}

export function searchRegionOf(trace: Trace, step: AdvanceStep): SearchRegion {
  const axes = axesOf(step);
  const [a, b, c] = cornersOf(trace, step.face);
  const squares = [subtract(b, a), subtract(c, b), subtract(a, c)].map((edge) => {
    const unit = coordinatesOf(edge, axes);
    return dot(unit, unit);
  });
  const base = Math.sqrt(squares.reduce((sum, square) => sum + square, 0) / 3);
  const size = Math.min(
    Math.max(edgePerTarget * step.targetEdge, minSizePerBase * base),
    maxSizePerBase * base,
  );
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

/** The columns of the tensor that maps the space of regular elements to space. */
function axesOf({ tensor }: AdvanceStep): SearchRegion["axes"] {
  const [xx, yy, zz, xy, xz, yz] = tensor ?? [1, 1, 1, 0, 0, 0];
  return [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
}

/** Returns the coordinates of a step of space along axes that need not be perpendicular. */
function coordinatesOf(step: Position, [first, second, third]: SearchRegion["axes"]): Position {
  const volume = dot(first, cross(second, third));
  return [
    dot(step, cross(second, third)) / volume,
    dot(step, cross(third, first)) / volume,
    dot(step, cross(first, second)) / volume,
  ];
}
