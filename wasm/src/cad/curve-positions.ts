/** Positions on curves and on surfaces of revolution, by the formulas of `trimmed-model.ts`. */
import { cosineAndSine } from "../base/same-everywhere.js";
import { plus, scaled, type Vector } from "../base/vectors.js";
import { splineAt } from "./splines.js";
import type { FaceSurface, SpaceCurve } from "./trimmed-model.js";

/** Returns the position at a parameter of a curve. */
export function positionOnCurve(curve: SpaceCurve, t: number): Vector {
  if (curve.kind === "spline") return splineAt(curve.spline, t, 3) as unknown as Vector;
  const { origin, x, y } = curve.frame;
  if (curve.kind === "line") return plus(origin, scaled(x, t));
  const minor = curve.kind === "circle" ? curve.radius : curve.minorRadius;
  const [cosine, sine] = cosineAndSine(t);
  return plus(origin, plus(scaled(x, curve.radius * cosine), scaled(y, minor * sine)));
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
  const [cosine, sine] = cosineAndSine(u);
  const around = plus(scaled(x, radius * cosine), scaled(y, radius * sine));
  return plus(plus(origin, around), scaled(z, height));
}

function profileOf(surface: RoundSurface, v: number): readonly [radius: number, height: number] {
  if (surface.kind === "cylinder") return [surface.radius, v];
  const [cosine, sine] = cosineAndSine(surface.kind === "cone" ? surface.halfAngle : v);
  switch (surface.kind) {
    case "cone":
      return [surface.radius + v * sine, v * cosine];
    case "sphere":
      return [surface.radius * cosine, surface.radius * sine];
    case "torus":
      return [surface.radius + surface.minorRadius * cosine, surface.minorRadius * sine];
  }
}
