/** Largest time step of a motion between two frames, in seconds. */
const maxStep = 0.1;

/** Draws on request: at most once per animation frame, and not at all if nothing has changed. */
export class FrameLoop {
  readonly #draw: (seconds: number) => boolean;
  readonly #listeners = new Set<() => void>();
  #handle = 0;
  #isStarted = false;
  #frames = 0;
  #lastDrawn = 0;

  /**
   * @param draw draws a frame, given the time since the last one in seconds; returns whether a motion
   * continues.
   */
  constructor(draw: (seconds: number) => boolean) {
    this.#draw = draw;
  }

  /** Number of frames drawn. */
  get frames(): number {
    return this.#frames;
  }

  /** Begins to draw. Requests made before have no effect. */
  start(): void {
    this.#isStarted = true;
    this.request();
  }

  /** Draws at the next animation frame. */
  request(): void {
    if (this.#isStarted && this.#handle === 0) this.#handle = requestAnimationFrame(() => this.drawNow());
  }

  /** Draws at once, instead of at the next animation frame. */
  drawNow(): void {
    if (!this.#isStarted) return;
    cancelAnimationFrame(this.#handle);
    this.#handle = 0;
    const now = performance.now();
    const goesOn = this.#draw(Math.min((now - this.#lastDrawn) / 1000, maxStep));
    this.#lastDrawn = now;
    ++this.#frames;
    for (const listener of this.#listeners) listener();
    if (goesOn) this.request();
  }

  /** Calls back after every frame. Returns a function that ends this. */
  onDrawn(listener: () => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Ends drawing permanently. */
  stop(): void {
    this.#isStarted = false;
    cancelAnimationFrame(this.#handle);
    this.#handle = 0;
  }
}
