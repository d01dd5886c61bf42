/** The shape that is filled with stretched triangles, and the fields of ellipses to which words of the text lead. */
import type { PlanePoint } from "../../kit/plane-view";
import type { Ellipse } from "./tensor-rules";

/** The background grid goes from (0, 0) to these coordinates. */
export const extent: PlanePoint = [1.9, 0.9];

/** The shape that is filled. */
export const outline: readonly PlanePoint[] = [
  [0.03, 0.26],
  [0.5, 0.03],
  [1.4, 0.06],
  [1.87, 0.46],
  [1.45, 0.87],
  [0.42, 0.82],
];

/** Corners of the background grid, counter-clockwise. */
const corners: readonly PlanePoint[] = [[0, 0], [extent[0], 0], extent, [0, extent[1]]];

function field(angles: readonly number[]): readonly Ellipse[] {
  return [...corners, [extent[0] / 2, extent[1] / 2] as const].map((at, i) => ({
    at,
    size: i === 4 ? 0.055 : 0.07,
    stretching: 3,
    angle: angles[i] ?? 0,
  }));
}

export const fields = {
  /** Wind over a hill. */
  hill: field([40, -40, -25, 25, 0]),
  /** Neighbours at right angles. */
  crossed: field([45, -45, 45, -45, 0]),
} as const;
export type FieldName = keyof typeof fields;
