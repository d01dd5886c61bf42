/** Positions on curves and on surfaces of revolution, by the formulas of `trimmed-model.ts`. */
import { plus, scaled, type Vector } from "../base/vectors.js";
import { splineAt } from "./splines.js";
import type { FaceSurface, SpaceCurve } from "./trimmed-model.js";

/** Returns the position at a parameter of a curve. */
export function positionOnCurve(curve: SpaceCurve, t: number): Vector {
  if (curve.kind === "spline") return splineAt(curve.spline, t, 3) as unknown as Vector;
  const { origin, x, y } = curve.frame;
  if (curve.kind === "line") return plus(origin, scaled(x, t));
  const minor = curve.kind === "circle" ? curve.radius : curve.minorRadius;
  return plus(origin, plus(scaled(x, curve.radius * Math.cos(t)), scaled(y, minor * Math.sin(t))));
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
