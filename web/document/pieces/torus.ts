import { plus, times, valueOf, type Quantity } from "../../expressions/quantity";
import { strings } from "../../strings";
import { turnBy, type QuantityPosition } from "../quantity-positions";
import { ShapeBuilder, type Shape } from "../shape";
import { turn } from "../vectors";

const names = strings.pieces.patches;

/** Patches around the tube. */
const around = 6;
/** Largest angle of a patch along the ring, in degrees. */
const maxAngle = 30;

/**
 * Returns a ring, or the sector of one, around the z axis: `radius` is that of the middle of the tube, `tubeRadius` that
 * of the tube, which is smaller. The sector begins at the x axis; `angle` is in degrees, and 360 closes the ring. Six Coons
 * patches around the tube, each along at most 30°, lie inside the ring by at most 0.37 % of the radius of the tube; the ends
 * of a sector are planar and exact.
 */
export function torus(radius: number, tubeRadius: number, angle: number): Shape;
export function torus(radius: Quantity, tubeRadius: Quantity, angle: Quantity): Shape<QuantityPosition>;
export function torus(radius: Quantity, tubeRadius: Quantity, angle: Quantity): Shape<QuantityPosition> {
  const builder = new ShapeBuilder<QuantityPosition>();
  const isClosed = valueOf(angle) >= 360;
  const steps = Math.max(isClosed ? 3 : 1, Math.ceil(valueOf(angle) / maxAngle - 1e-9));
  const at = (station: number, corner: number): QuantityPosition => {
    const [alongX, alongY] = turnBy(times(station / steps, isClosed ? 360 : angle));
    const [out, up] = turn(corner / around);
    const reach = plus(radius, times(tubeRadius, out));
    return [times(reach, alongX), times(reach, alongY), times(tubeRadius, up)];
  };
  const corners = Array.from({ length: around }, (_, corner) => corner);
  const stations = Array.from({ length: isClosed ? steps : steps + 1 }, (_, station) => station);
  const points = stations.map((station) => corners.map((corner) => builder.point(at(station, corner))));
  const pointAt = (station: number, corner: number): number =>
    points[station % stations.length]?.[corner % around] ?? 0;
  const sections = stations.map((station) =>
    corners.map((corner) => {
      const middle = builder.point(at(station, corner + 0.5));
      return builder.line("arc", [pointAt(station, corner), middle, pointAt(station, corner + 1)]);
    }),
  );
  const sectionAt = (station: number, corner: number): number =>
    sections[station % stations.length]?.[corner] ?? 0;
  for (let station = 0; station < steps; ++station) {
    const rails = corners.map((corner) => {
      const middle = builder.point(at(station + 0.5, corner));
      return builder.line("arc", [pointAt(station, corner), middle, pointAt(station + 1, corner)]);
    });
    for (const corner of corners) {
      const next = rails[(corner + 1) % around] ?? 0;
      const loop = [rails[corner] ?? 0, sectionAt(station + 1, corner), -next, -sectionAt(station, corner)];
      builder.patch("coons", [loop], names.numbered(names.side, builder.patches.length + 1));
    }
  }
  if (!isClosed) {
    builder.patch("planar", [sections[0] ?? []], names.start);
    builder.patch("planar", [sections.at(-1) ?? []], names.end);
  }
  return builder.shape;
}
