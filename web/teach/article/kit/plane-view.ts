/** A window of the plane on a stage: y goes up, and the whole window is visible. */
import type { Pixel, Stage } from "./stage";

export type PlanePoint = readonly [number, number];

export class PlaneView {
  /** @param window Smallest x and y, largest x and y. */
  constructor(
    readonly stage: Stage,
    readonly window: readonly [number, number, number, number],
  ) {}

  /** Pixels per unit. */
  get scale(): number {
    const [x0, y0, x1, y1] = this.window;
    return Math.min(this.stage.width / (x1 - x0), this.stage.height / (y1 - y0));
  }

  pixel([x, y]: PlanePoint): Pixel {
    const [x0, y0, x1, y1] = this.window;
    return [
      this.stage.width / 2 + (x - (x0 + x1) / 2) * this.scale,
      this.stage.height / 2 - (y - (y0 + y1) / 2) * this.scale,
    ];
  }

  point([x, y]: Pixel): PlanePoint {
    const [x0, y0, x1, y1] = this.window;
    return [
      (x0 + x1) / 2 + (x - this.stage.width / 2) / this.scale,
      (y0 + y1) / 2 - (y - this.stage.height / 2) / this.scale,
    ];
  }

  /** Returns a point moved into the window, at least a margin from its border. */
  inside([x, y]: PlanePoint, margin: number): PlanePoint {
    const [x0, y0, x1, y1] = this.window;
    return [Math.min(x1 - margin, Math.max(x0 + margin, x)), Math.min(y1 - margin, Math.max(y0 + margin, y))];
  }
}
