/** Features of solids for tests, and what the kernel measures on them. */
import type { TopoDS_Shape } from "replicad-opencascadejs";

import { withShape } from "../../wasm/dist/cad/features/evaluate.js";
import type {
  Feature,
  FeatureOf,
  Loop,
  LoopCurve,
  Operation,
  Placement,
} from "../../wasm/dist/cad/features/feature.js";
import type { FeatureKernel } from "../../wasm/dist/cad/features/session.js";
import type { Vector } from "../../wasm/dist/base/vectors.js";

export const UPRIGHT: Placement = { position: [0, 0, 0], axis: [0, 0, 1] };

/** Returns a straight line at each side of a polygon. */
export const polygonLoop = (...corners: readonly Vector[]): Loop =>
  corners.map((corner, c): LoopCurve => ({
    kind: "line",
    points: [corner, corners[(c + 1) % corners.length] ?? corner],
  }));

export const squareLoop = (low: number, high: number, z = 0): Loop =>
  polygonLoop([low, low, z], [high, low, z], [high, high, z], [low, high, z]);

export const circleLoop = (radius: number, center: Vector = [0, 0, 0]): Loop => [
  { kind: "circle", center, axis: [0, 0, 1], radius },
];

/** A box with a corner at the origin or at a position. */
export const boxFeature = (
  id: number,
  size: Vector,
  position: Vector = [0, 0, 0],
  operation: Operation = "new",
): FeatureOf<"box"> => {
  const [x, y, z] = position;
  const middle: Vector = [x + size[0] / 2, y + size[1] / 2, z];
  return { id, type: "box", operation, ...UPRIGHT, position: middle, size };
};

interface Measures {
  readonly volume: number;
  readonly area: number;
}

/** Returns volume and area of the solid of features, and the rest of the evaluation. */
export function measured(kernel: FeatureKernel, features: readonly Feature[]) {
  const { result, ...evaluation } = withShape(kernel, features, (shape) => measuresOf(kernel, shape));
  return { ...evaluation, ...(result ?? { volume: 0, area: 0 }) };
}

function measuresOf(kernel: FeatureKernel, shape: TopoDS_Shape): Measures {
  const properties = () => new kernel.GProp_GProps();
  const [volume, area] = [properties(), properties()];
  kernel.BRepGProp.VolumeProperties(shape, volume, false, false, false);
  kernel.BRepGProp.SurfaceProperties(shape, area, false, false);
  const measures = { volume: volume.Mass(), area: area.Mass() };
  volume.delete();
  area.delete();
  return measures;
}

/** Returns the names of features' faces, in the order of the alphabet. */
export const namesOf = (kernel: FeatureKernel, features: readonly Feature[]): string[] =>
  [...measured(kernel, features).faces].sort();
