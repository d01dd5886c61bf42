/** Ends, bounds and parameters of curves in the parameter plane. */
import { cosineAndSine } from "../base/same-everywhere.js";
import { splineAt } from "./splines.js";
import type { PlaneCurve, PlaneFrame, PlaneVector } from "./trimmed-model.js";

const onFrame = ({ origin, x, y }: PlaneFrame, r: number, s: number): PlaneVector => [
  origin[0] + r * x[0] + s * y[0],
  origin[1] + r * x[1] + s * y[1],
];

/** Returns the positions at both ends of a range. */
export function endsOf(curve: PlaneCurve, [first, last]: PlaneVector): readonly [PlaneVector, PlaneVector] {
  return [positionOn(curve, first), positionOn(curve, last)];
}

function positionOn(curve: PlaneCurve, t: number): PlaneVector {
  switch (curve.kind) {
    case "line":
      return onFrame(curve.frame, t, 0);
    case "circle":
    case "ellipse": {
      const [cosine, sine] = cosineAndSine(t);
      const minor = curve.kind === "circle" ? curve.radius : curve.minorRadius;
      return onFrame(curve.frame, curve.radius * cosine, minor * sine);
    }
    case "spline":
      return splineAt(curve.spline, t, 2) as unknown as PlaneVector;
  }
}

/** Returns the lowest and the highest coordinates of a box that contains a curve over a range. */
export function boundsOf(curve: PlaneCurve, range: PlaneVector): readonly [PlaneVector, PlaneVector] {
  const points: PlaneVector[] = [...endsOf(curve, range)];
  if (curve.kind === "circle" || curve.kind === "ellipse") {
    const { origin } = curve.frame;
    const { radius } = curve;
    points.push([origin[0] - radius, origin[1] - radius], [origin[0] + radius, origin[1] + radius]);
  } else if (curve.kind === "spline") {
    const { poles } = curve.spline;
    for (let i = 0; i < poles.length; i += 2) points.push([poles[i] ?? 0, poles[i + 1] ?? 0]);
  }
  const low = points.reduce((a, b) => [Math.min(a[0], b[0]), Math.min(a[1], b[1])]);
  const high = points.reduce((a, b) => [Math.max(a[0], b[0]), Math.max(a[1], b[1])]);
  return [low, high];
}

const SAME = 1e-12;

/** Returns a curve with another range of its parameter; undefined for circles and ellipses whose range differs. */
export function reparameterized(
  curve: PlaneCurve,
  from: PlaneVector,
  to: PlaneVector,
): PlaneCurve | undefined {
  const length = Math.max(1, Math.abs(to[0]), Math.abs(to[1]));
  if (Math.abs(from[0] - to[0]) <= SAME * length && Math.abs(from[1] - to[1]) <= SAME * length) return curve;
  const moved = (t: number) => to[0] + ((t - from[0]) / (from[1] - from[0])) * (to[1] - to[0]);
  if (curve.kind === "spline")
    return { kind: "spline", spline: { ...curve.spline, knots: curve.spline.knots.map(moved) } };
  if (curve.kind !== "line") return undefined;
  const [begin, end] = endsOf(curve, from);
  const knots = Float64Array.of(to[0], to[0], to[1], to[1]);
  const poles = Float64Array.of(...begin, ...end);
  return { kind: "spline", spline: { degree: 1, knots, poles, weights: new Float64Array() } };
}
