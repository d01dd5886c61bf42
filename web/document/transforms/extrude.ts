import type { Project } from "tetrafront/project";
import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import type { Entity } from "../entities";
import { valuesOf, type QuantityPosition } from "../quantity-positions";
import { ShapeBuilder, type Shape } from "../shape";
import { length } from "../vectors";
import { profileOf, type Profile } from "./profile";
import { offerSweep, profilePoints, type SweepOptions, type SweptPoint } from "./sweep";
import { typedTranslation } from "./typed-maps";

const texts = operationStrings.refusals;

/**
 * Returns the surface that a profile sweeps along a vector, with the profile at both ends. Straight lines give planar sides,
 * closed lines tubes, and other lines Coons patches; all are exact.
 */
export function extruded({ shape, outline }: Profile): Shape<SweptPoint> {
  const builder = new ShapeBuilder({ ...shape, points: profilePoints(shape) });
  const count = shape.points.length;
  for (let index = 0; index < count; ++index) builder.point({ index, station: 1 });
  const tops = shape.lines.map(({ type, points }) =>
    builder.line(
      type,
      points.map((point) => point + count),
    ),
  );
  const topOf = (line: number): number => Math.sign(line) * (tops[Math.abs(line) - 1] ?? 0);
  for (const line of outline) {
    const { type, points } = shape.lines[line - 1] ?? { type: "straight", points: [] };
    const [from = 0, to = 0] = [points.at(0), points.at(-1)];
    if (from === to) builder.patch("tube", [[line], [topOf(line)]]);
    else {
      const sides = [builder.straight(from, from + count), builder.straight(to, to + count)] as const;
      builder.patch(type === "straight" ? "planar" : "coons", [[line, sides[1], -topOf(line), -sides[0]]]);
    }
  }
  for (const { type, loops } of shape.patches)
    builder.patch(
      type,
      loops.map((loop) => loop.map(topOf)),
    );
  return builder.shape;
}

/** Offers to sweep the selected patches and lines along a vector. */
export function offerExtrusion(
  project: Project,
  selection: readonly Entity[],
  vector: QuantityPosition,
  options: SweepOptions,
): Offer {
  const profile = profileOf(project, selection);
  if (!profile) return { possible: false, reason: texts.noProfile };
  if (length(valuesOf(vector)) === 0) return { possible: false, reason: texts.nothingMoves };
  return offerSweep(project, profile, extruded(profile), () => typedTranslation(vector), options);
}
