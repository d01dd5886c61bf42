import { CatmullRomCurve3, Vector3 } from "three";
import type { LineType } from "tetrafront/project";
import { runsThroughMany } from "../document/line-types";
import { samplesAlong } from "../document/line-samples";
import type { Position } from "../document/position";

/** Segments per piece of a spline. */
const segments = 24;

/**
 * Returns positions along a line that is being drawn through some positions, which may not be complete yet. The engine
 * samples lines of the project; a spline differs from its samples by little.
 */
export function sampledCurve(type: LineType, through: readonly Position[]): readonly Position[] {
  const [a] = through;
  if (!a || through.length < 3) return through;
  if (!runsThroughMany(type)) return samplesAlong(type, through);
  const last = through.at(-1) ?? a;
  const closed = through.length > 3 && a.every((x, k) => x === last[k]);
  const points = (closed ? through.slice(0, -1) : through).map((position) => new Vector3(...position));
  const curve = new CatmullRomCurve3(points, closed);
  return curve.getPoints(segments * points.length).map(({ x, y, z }) => [x, y, z]);
}
