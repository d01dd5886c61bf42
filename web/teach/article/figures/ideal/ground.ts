/** The ground of a scene: a grid in a level plane that fades out, and circles on it. */
import type { Position } from "../../../../document/position";
import type { Colour } from "../../kit/colours";
import type { Pen } from "../../kit/pen";
import type { Camera } from "../../kit/space";

const spacing = 0.2;
const extent = 1.8;

export function drawGround(pen: Pen, camera: Camera, colour: Colour, z = 0): void {
  const count = Math.round(extent / spacing);
  for (let i = -count; i <= count; i++)
    for (let j = -count; j < count; j++) {
      const [across, from, to] = [i * spacing, j * spacing, (j + 1) * spacing];
      const alpha = 0.13 * Math.max(0, 1 - Math.hypot(across, (from + to) / 2) / extent);
      if (alpha < 0.004) continue;
      pen.line(camera.pixel([across, from, z]), camera.pixel([across, to, z]), colour, 1, { alpha });
      pen.line(camera.pixel([from, across, z]), camera.pixel([to, across, z]), colour, 1, { alpha });
    }
}

/** Returns points of a circle on the ground. */
export const sectorPoints = (centre: Position, radius: number): readonly Position[] =>
  Array.from({ length: 96 }, (_none, i) => {
    const angle = (i * Math.PI) / 48;
    return [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle), 0];
  });
