import { Resolution } from "./resolution";

/** A view without a new frame for this time is at rest, in milliseconds: drawing it sharply can take longer than a frame. */
const restMs = 300;
/** And for this many frames of the page: they take longer than that where drawing is very slow. */
const restTicks = 3;

/** Watches whether the view moves, and how fast its frames follow each other; chooses its resolution accordingly. */
export class MotionWatch {
  readonly #onRest: () => void;
  readonly #resolution = new Resolution();
  #handle = 0;
  #lastDrawn = 0;
  #lastTick = 0;
  #ticksWithoutFrame = 0;
  #isMoving = false;

  /** @param onRest called when a motion has ended. */
  constructor(onRest: () => void) {
    this.#onRest = onRest;
  }

  /**
   * Returns the share of the full resolution for the frame that is drawn now. One frame alone, such as that of a new
   * selection, is no motion.
   */
  nextFrame(): number {
    this.#lastDrawn = performance.now();
    this.#ticksWithoutFrame = 0;
    if (this.#handle !== 0) {
      this.#isMoving = true;
      return this.#resolution.scale;
    }
    this.#lastTick = this.#lastDrawn;
    this.#request();
    return 1;
  }

  stop(): void {
    cancelAnimationFrame(this.#handle);
    this.#handle = 0;
  }

  #request(): void {
    this.#handle = requestAnimationFrame(() => this.#tick());
  }

  /** While frames are drawn too slowly, the browser calls this as slowly. */
  #tick(): void {
    const now = performance.now();
    if (this.#isMoving) this.#resolution.add(now - this.#lastTick);
    this.#lastTick = now;
    if (++this.#ticksWithoutFrame < restTicks || now - this.#lastDrawn < restMs) return this.#request();
    this.#handle = 0;
    this.#isMoving = false;
    this.#resolution.rest();
    this.#onRest();
  }
}
