/** The exact stress as a picture. It is the same in all four quarters around the hole, so one of them is computed. */
import type { Colour } from "../../kit/colours";
import type { PlanePoint } from "../../kit/plane-view";
import { exactStress, type Hole } from "./exact-plate";
import { plate } from "./plate-mesh";

interface Quarter {
  readonly picture: HTMLCanvasElement;
  /** Width and height in units of the plate. */
  readonly size: PlanePoint;
}

/** A coarse picture of everything, and a fine one of the surroundings of the hole. */
const pictures: readonly { readonly size: PlanePoint; readonly pixels: readonly [number, number] }[] = [
  { size: [2 * plate[0], 2 * plate[1]], pixels: [80, 44] },
  { size: [0.42, 0.42], pixels: [68, 68] },
];

export class TruthPicture {
  #quarters: readonly Quarter[] = [];
  #key = "";

  /** Draws around the middle of the hole, at the origin of the context, which has units of the plate. */
  draw(context: CanvasRenderingContext2D, hole: Hole, colour: (stress: number) => Colour): void {
    const key = [hole.a, hole.b, ...colour(0), ...colour(1)].join();
    if (key !== this.#key) {
      this.#key = key;
      this.#quarters = pictures.map(({ size, pixels }) => quarterOf(hole, colour, size, pixels));
    }
    context.imageSmoothingEnabled = true;
    context.imageSmoothingQuality = "high";
    for (const { picture, size } of this.#quarters)
      for (const [sx, sy] of [
        [1, 1],
        [-1, 1],
        [1, -1],
        [-1, -1],
      ] as const) {
        context.save();
        context.scale(sx, sy);
        context.drawImage(picture, 0, 0, ...size);
        context.restore();
      }
  }
}

function quarterOf(
  hole: Hole,
  colour: (stress: number) => Colour,
  size: PlanePoint,
  [width, height]: readonly [number, number],
): Quarter {
  const picture = document.createElement("canvas");
  picture.width = width;
  picture.height = height;
  const context = picture.getContext("2d");
  const image = context?.createImageData(width, height);
  if (!context || !image) throw new Error("The browser has no canvas.");
  const centred: Hole = { ...hole, at: [0, 0] };
  for (let j = 0; j < height; j++)
    for (let i = 0; i < width; i++) {
      const at: PlanePoint = [((i + 0.5) / width) * size[0], ((j + 0.5) / height) * size[1]];
      const [stress] = exactStress(centred, at);
      const [red, green, blue] = colour(stress);
      const pixel = 4 * (j * width + i);
      image.data[pixel] = red;
      image.data[pixel + 1] = green;
      image.data[pixel + 2] = blue;
      image.data[pixel + 3] = 255;
    }
  context.putImageData(image, 0, 0);
  return { picture, size };
}

/**
 * Returns lines of force. Stress along x is carried by (xx, xy), a field without sources, so the lines are as close together as
 * the stress is high.
 */
export function forceLines(hole: Hole, count: number): readonly (readonly PlanePoint[])[] {
  const steps = 60;
  // Steps grow with the distance from the hole, near which the lines are most curved.
  const stepShares = Array.from({ length: steps }, (_none, i) => (0.3 + (1.4 * (i + 0.5)) / steps) / steps);
  const lines: PlanePoint[][] = [];
  // From the line through the middle of the hole outwards: between two lines is the same force.
  for (const side of [1, -1]) {
    const starts: number[] = [];
    const [from, to] = [hole.at[1] + side * hole.b, side * plate[1]];
    const samples = 300;
    let force = -0.5 * (1 / count);
    for (let i = 0; i < samples; i++) {
      const y = from + ((to - from) * (i + 0.5)) / samples;
      force += (exactStress(hole, [hole.at[0], y])[0] * Math.abs(to - from)) / samples;
      if (force > 0) {
        starts.push(y);
        force -= 1 / count;
      }
    }
    for (const y of starts) {
      const halves = [-1, 1].map((direction) => {
        const half: PlanePoint[] = [];
        let at: PlanePoint = [hole.at[0], y];
        for (const share of stepShares) {
          const length = (direction * plate[0] - hole.at[0]) * share;
          const [xx, , xy] = exactStress(hole, at);
          const middle: PlanePoint = [at[0] + length / 2, at[1] + (length / 2) * (xy / Math.max(0.05, xx))];
          const [mxx, , mxy] = exactStress(hole, middle);
          at = [at[0] + length, at[1] + length * (mxy / Math.max(0.05, mxx))];
          half.push(at);
        }
        return half;
      }) as [PlanePoint[], PlanePoint[]];
      lines.push([...halves[0].reverse(), [hole.at[0], y], ...halves[1]]);
    }
  }
  return lines;
}
