/** Positions on curves and on surfaces of revolution, by the formulas of `trimmed-model.ts`. */
import { plus, scaled, type Vector } from "../base/vectors.js";
import type { FaceSurface, SpaceCurve, SplineCurve } from "./trimmed-model.js";

/** Returns the position at a parameter of a curve. */
export function positionOnCurve(curve: SpaceCurve, t: number): Vector {
  if (curve.kind === "spline") return positionOnSpline(curve.spline, t);
  const { origin, x, y } = curve.frame;
  if (curve.kind === "line") return plus(origin, scaled(x, t));
  const minor = curve.kind === "circle" ? curve.radius : curve.minorRadius;
  return plus(origin, plus(scaled(x, curve.radius * Math.cos(t)), scaled(y, minor * Math.sin(t))));
}

/** De Boor's algorithm on weighted poles. */
function positionOnSpline({ degree, knots, poles, weights }: SplineCurve, t: number): Vector {
  const count = poles.length / 3;
  const knot = (k: number): number => knots[k] ?? 0;
  const at = Math.min(Math.max(t, knot(degree)), knot(count));
  let span = degree;
  while (span + 1 < count && at >= knot(span + 1)) span++;
  let rows = Array.from({ length: degree + 1 }, (_, k) => {
    const pole = span - degree + k;
    const weight = weights[pole] ?? 1;
    const of = (axis: number): number => weight * (poles[3 * pole + axis] ?? 0);
    return [of(0), of(1), of(2), weight] as const;
  });
  for (let level = 1; level <= degree; level++)
    rows = rows.slice(1).map((row, k) => {
      const before = rows[k] ?? row;
      const begin = knot(span - degree + k + level);
      const share = (at - begin) / (knot(span + 1 + k) - begin);
      const mix = (axis: 0 | 1 | 2 | 3): number => (1 - share) * before[axis] + share * row[axis];
      return [mix(0), mix(1), mix(2), mix(3)] as const;
    });
  const [x, y, z, weight] = rows[0] ?? [0, 0, 0, 1];
  return [x / weight, y / weight, z / weight];
}

/** A surface that a circle or a straight line makes when it is turned around the z axis of its frame. */
export type RoundSurface = Extract<FaceSurface, { readonly kind: "cylinder" | "cone" | "sphere" | "torus" }>;

export const isRound = (surface: FaceSurface): surface is RoundSurface =>
  surface.kind === "cylinder" ||
  surface.kind === "cone" ||
  surface.kind === "sphere" ||
  surface.kind === "torus";

/** Returns the position at the parameters u (the angle about the axis) and v. */
export function positionOnRound(surface: RoundSurface, u: number, v: number): Vector {
  const [radius, height] = profileOf(surface, v);
  const { origin, x, y, z } = surface.frame;
  const around = plus(scaled(x, radius * Math.cos(u)), scaled(y, radius * Math.sin(u)));
  return plus(plus(origin, around), scaled(z, height));
}

function profileOf(surface: RoundSurface, v: number): readonly [radius: number, height: number] {
  switch (surface.kind) {
    case "cylinder":
      return [surface.radius, v];
    case "cone":
      return [surface.radius + v * Math.sin(surface.halfAngle), v * Math.cos(surface.halfAngle)];
    case "sphere":
      return [surface.radius * Math.cos(v), surface.radius * Math.sin(v)];
    case "torus":
      return [surface.radius + surface.minorRadius * Math.cos(v), surface.minorRadius * Math.sin(v)];
  }
}
