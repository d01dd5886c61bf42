/** A window of the plane on a stage: y goes up, and the whole window is visible. */
import type { Pixel, Stage } from "./stage";

export type PlanePoint = readonly [number, number];

type PlaneWindow = readonly [number, number, number, number];

export class PlaneView {
  /**
   * @param wide Smallest x and y, largest x and y.
   * @param narrow The window on a stage that is narrower than a number of pixels; its height then fills the stage, so that a unit
   * of y is longer than one of x.
   */
  constructor(
    readonly stage: Stage,
    readonly wide: PlaneWindow,
    readonly narrow?: { readonly below: number; readonly window: PlaneWindow },
  ) {}

  get window(): PlaneWindow {
    return this.#isNarrow && this.narrow ? this.narrow.window : this.wide;
  }

  get #isNarrow(): boolean {
    return this.narrow !== undefined && this.stage.width < this.narrow.below;
  }

  /** Pixels per unit of x. */
  get scale(): number {
    const [x0, y0, x1, y1] = this.window;
    const across = this.stage.width / (x1 - x0);
    return this.#isNarrow ? across : Math.min(across, this.stage.height / (y1 - y0));
  }

  /** Pixels per unit of y. */
  get scaleY(): number {
    const [, y0, , y1] = this.window;
    return this.#isNarrow ? this.stage.height / (y1 - y0) : this.scale;
  }

  pixel([x, y]: PlanePoint): Pixel {
    const [x0, y0, x1, y1] = this.window;
    return [
      this.stage.width / 2 + (x - (x0 + x1) / 2) * this.scale,
      this.stage.height / 2 - (y - (y0 + y1) / 2) * this.scaleY,
    ];
  }

  point([x, y]: Pixel): PlanePoint {
    const [x0, y0, x1, y1] = this.window;
    return [
      (x0 + x1) / 2 + (x - this.stage.width / 2) / this.scale,
      (y0 + y1) / 2 - (y - this.stage.height / 2) / this.scaleY,
    ];
  }

  /** Returns a point moved into the window, at least a margin from its border. */
  inside([x, y]: PlanePoint, margin: number): PlanePoint {
    const [x0, y0, x1, y1] = this.window;
    return [Math.min(x1 - margin, Math.max(x0 + margin, x)), Math.min(y1 - margin, Math.max(y0 + margin, y))];
  }
}
