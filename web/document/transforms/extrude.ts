import type { Project } from "tetrafront";
import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import type { Entity } from "../entities";
import { insertion, withInsertion } from "../insert-shape";
import type { Position } from "../position";
import { ShapeBuilder, type Shape } from "../shape";
import { add, length } from "../vectors";
import { profileOf, type Profile } from "./profile";
import { replacing } from "./join-points";

const texts = operationStrings.refusals;

/**
 * Returns the surface that a profile sweeps along a vector, with the profile at both ends. Straight lines give planar sides,
 * closed lines tubes, and other lines Coons patches; all are exact.
 */
export function extruded({ shape, outline }: Profile, vector: Position): Shape {
  const builder = new ShapeBuilder(shape);
  const count = shape.points.length;
  for (const position of shape.points) builder.point(add(position, vector));
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

export interface SweepOptions {
  readonly label: string;
  /** Keep the selected patches, also where they then separate two regions. */
  readonly keepBase: boolean;
}

/** Offers to sweep the selected patches and lines along a vector. */
export function offerExtrusion(
  project: Project,
  selection: readonly Entity[],
  vector: Position,
  options: SweepOptions,
): Offer {
  const profile = profileOf(project, selection);
  if (!profile) return { possible: false, reason: texts.noProfile };
  if (length(vector) === 0) return { possible: false, reason: texts.nothingMoves };
  return offerSweep(project, profile, extruded(profile, vector), options);
}

/** Offers to add what a profile has swept. */
export function offerSweep(
  project: Project,
  { patchIds }: Profile,
  swept: Shape,
  { label, keepBase }: SweepOptions,
): Offer {
  const base = new Set(keepBase ? [] : patchIds);
  const kept = base.size === 0 ? project.patches : project.patches.filter(({ id }) => !base.has(id));
  const made = insertion(project, swept, { join: true });
  // With `keepBase` off, the patches of the base are neither kept nor added again: they have the same lines.
  const lists = withInsertion({ ...project, patches: kept }, made);
  return {
    possible: true,
    creation: {
      entities: made.patchIds.filter((id) => !base.has(id)).map((id) => ({ kind: "patch", id })),
      edit: { label, replace: replacing(project, lists) },
    },
  };
}
