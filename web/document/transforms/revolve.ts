import type { Project } from "tetrafront/project";
import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import type { Entity } from "../entities";
import { coincidenceLength } from "../insert-shape";
import { over, times, valueOf, type Quantity } from "../../expressions/quantity";
import type { Position } from "../position";
import { valuesOf, type QuantityPosition } from "../quantity-positions";
import { ShapeBuilder, type Shape, type ShapeLine } from "../shape";
import { addScaled, cross, dot, length, subtract, unit } from "../vectors";
import { profileOf, type Profile } from "./profile";
import { offerSweep, profilePoints, type SweepOptions, type SweptPoint } from "./sweep";
import { typedRotation } from "./typed-maps";

const texts = operationStrings.refusals;

/** Largest angle of a patch, in degrees: straight lines sweep exact patches, others are blended. */
const maxAngle = { straight: 90, curved: 30 };

/** The axis and the angle as numbers. */
interface Revolution {
  readonly point: Position;
  /** A direction of length 1. */
  readonly axis: Position;
  /** Degrees, counter-clockwise around the axis; a full turn closes the surface. */
  readonly angle: number;
}

/** A revolution whose numbers may have been typed as expressions. */
export interface TypedRevolution {
  readonly point: QuantityPosition;
  /** A direction of any length. */
  readonly axis: QuantityPosition;
  readonly angle: Quantity;
}

/**
 * Offers to sweep the selected patches and lines about an axis. After a full turn, the selected patches are inside and are
 * removed.
 */
export function offerRevolution(
  project: Project,
  selection: readonly Entity[],
  typed: TypedRevolution,
  options: SweepOptions,
): Offer {
  const axis = unit(valuesOf(typed.axis));
  if (!axis) return { possible: false, reason: operationStrings.noDirection };
  const revolution = { point: valuesOf(typed.point), axis, angle: valueOf(typed.angle) };
  const profile = profileOf(project, selection);
  if (!profile) return { possible: false, reason: texts.noProfile };
  if (revolution.angle === 0) return { possible: false, reason: texts.nothingMoves };
  const { lines, points } = profile.shape;
  if (lines.some((line) => line.points[0] === line.points.at(-1))) {
    return { possible: false, reason: texts.closedProfile };
  }
  const tolerance = coincidenceLength(project);
  if (isAcross(points, revolution, tolerance)) return { possible: false, reason: texts.acrossAxis };
  const isFull = Math.abs(revolution.angle) >= 360;
  const { swept, steps } = revolved(profile, revolution, tolerance);
  // What decides how many steps there are does not follow parameters: a full turn stays one.
  const angle = isFull ? Math.sign(revolution.angle) * 360 : typed.angle;
  const mapTo = (station: number) =>
    typedRotation(typed.point, typed.axis, over(times(station, angle), steps));
  return offerSweep(project, profile, swept, mapTo, {
    ...options,
    keepBase: options.keepBase && !isFull,
  });
}

/** Returns the vector from the axis to a position. */
function armOf(position: Position, { point, axis }: Revolution): Position {
  const offset = subtract(position, point);
  return addScaled(offset, axis, -dot(offset, axis));
}

/** Returns whether two of the positions lie on opposite sides of the axis. */
function isAcross(positions: readonly Position[], revolution: Revolution, tolerance: number): boolean {
  const arms = positions
    .map((position) => armOf(position, revolution))
    .filter((arm) => length(arm) > tolerance);
  return arms.some((arm) => dot(arm, arms[0] ?? arm) < 0);
}

/**
 * Returns the surface that a profile sweeps about an axis, with the profile at both ends unless it closes. A line with one
 * end on the axis sweeps triangles: planar ones if it is perpendicular to the axis, else Barnhill–Gregory–Nielson.
 */
function revolved(
  { shape, outline }: Profile,
  revolution: Revolution,
  tolerance: number,
): { readonly swept: Shape<SweptPoint>; readonly steps: number } {
  const { angle } = revolution;
  const isFull = Math.abs(angle) >= 360;
  const turnOf = isFull ? Math.sign(angle) * 360 : angle;
  const isStraight = shape.lines.every(({ type }) => type === "straight");
  const most = isStraight ? maxAngle.straight : maxAngle.curved;
  const steps = Math.ceil(Math.abs(turnOf) / most - 1e-9);
  const builder = new ShapeBuilder({ ...shape, points: profilePoints(shape) });
  const onAxis = shape.points.map((position) => length(armOf(position, revolution)) <= tolerance);
  const own = shape.points.map((_, index) => index);
  const stations = Array.from({ length: steps + 1 }, (_, station): readonly number[] =>
    station === 0 || (isFull && station === steps)
      ? own
      : own.map((index) => (onAxis[index] === true ? index : builder.point({ index, station }))),
  );
  const copied = stations.map((ids): readonly number[] =>
    ids === own ? shape.lines.map((_, index) => index + 1) : copyLines(builder, shape.lines, ids, onAxis),
  );
  const swept = new SweptSides(shape, revolution, onAxis);
  for (let station = 0; station < steps; ++station) {
    const rails = own.map((index) => {
      const [from, to] = [stations[station]?.[index] ?? 0, stations[station + 1]?.[index] ?? 0];
      const isNeeded = onAxis[index] !== true && swept.ends(outline).has(index);
      return isNeeded ? builder.line("arc", [from, builder.point({ index, station: station + 0.5 }), to]) : 0;
    });
    const [before, after] = [copied[station] ?? [], copied[station + 1] ?? []];
    for (const line of outline) swept.add(builder, line, before, after, rails);
  }
  const last = copied.at(-1) ?? [];
  if (!isFull) {
    for (const { type, loops } of shape.patches) {
      const moved = loops.map((loop) =>
        loop.map((step) => Math.sign(step) * (last[Math.abs(step) - 1] ?? 0)),
      );
      builder.patch(type, moved);
    }
  }
  const result = builder.shape;
  // After a full turn, the profile itself lies inside.
  const patches = isFull ? result.patches.slice(shape.patches.length) : result.patches;
  return { swept: { ...result, patches }, steps };
}

/** Adds copies of lines with other points. Lines on the axis stay. Returns their numbers. */
function copyLines(
  builder: ShapeBuilder<SweptPoint>,
  lines: readonly ShapeLine[],
  ids: readonly number[],
  onAxis: readonly boolean[],
): number[] {
  return lines.map(({ type, points }, index) =>
    points.every((point) => onAxis[point] === true)
      ? index + 1
      : builder.line(
          type,
          points.map((point) => ids[point] ?? point),
        ),
  );
}

/** Makes the patches that lines sweep from one station to the next. */
class SweptSides {
  readonly #shape: Shape;
  readonly #revolution: Revolution;
  readonly #onAxis: readonly boolean[];

  constructor(shape: Shape, revolution: Revolution, onAxis: readonly boolean[]) {
    this.#shape = shape;
    this.#revolution = revolution;
    this.#onAxis = onAxis;
  }

  /** The ends of lines. */
  ends(lines: readonly number[]): ReadonlySet<number> {
    return new Set(lines.flatMap((line) => this.#endsOf(line)));
  }

  add(
    builder: ShapeBuilder<SweptPoint>,
    line: number,
    before: readonly number[],
    after: readonly number[],
    rails: readonly number[],
  ): void {
    const [from = 0, to = 0] = this.#endsOf(line);
    const [near, far] = [before[line - 1] ?? 0, after[line - 1] ?? 0];
    const [start, end] = [rails[from] ?? 0, rails[to] ?? 0];
    if (near === far) return;
    const isPlanar = this.#isPerpendicular(line);
    if (this.#onAxis[from] === true) {
      // The arc is the second line, which has a role of its own.
      builder.patch(isPlanar ? "planar" : "barnhill-gregory-nielson", [[near, end, -far]]);
    } else if (this.#onAxis[to] === true) {
      builder.patch(isPlanar ? "planar" : "barnhill-gregory-nielson", [[-near, start, far]]);
    } else {
      builder.patch(isPlanar ? "planar" : "coons", [[near, end, -far, -start]]);
    }
  }

  #endsOf(line: number): number[] {
    const { points = [] } = this.#shape.lines[line - 1] ?? {};
    return [points.at(0) ?? 0, points.at(-1) ?? 0];
  }

  /** Returns whether all points of a line have the same position along the axis. */
  #isPerpendicular(line: number): boolean {
    const { points = [] } = this.#shape.lines[line - 1] ?? {};
    const { point, axis } = this.#revolution;
    const positions = points.map((index) => this.#shape.points[index] ?? point);
    const [first = point] = positions;
    const heights = positions.map((position) => Math.abs(dot(subtract(position, first), axis)));
    const reach = Math.max(...positions.map((position) => length(cross(subtract(position, point), axis))));
    return Math.max(...heights) <= 1e-9 * reach;
  }
}
