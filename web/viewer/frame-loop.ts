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
  /** Number of pieces of work that frames wait for. */
  #awaited = 0;
  #isRequested = false;

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

  /** Time since the last frame, in milliseconds; 0 while a frame is due. */
  get restedMs(): number {
    return this.#isRequested ? 0 : performance.now() - this.#lastDrawn;
  }

  /** Draws at the next animation frame. */
  request(): void {
    if (!this.#isStarted) return;
    this.#isRequested = true;
    if (this.#awaited === 0 && this.#handle === 0) this.#handle = requestAnimationFrame(() => this.drawNow());
  }

  /** Lets the frames that are requested wait until some work has ended. */
  async waitFor(work: Promise<void>): Promise<void> {
    ++this.#awaited;
    cancelAnimationFrame(this.#handle);
    this.#handle = 0;
    try {
      await work;
    } finally {
      --this.#awaited;
      if (this.#isRequested) this.request();
    }
  }

  /** Draws at once, instead of at the next animation frame. */
  drawNow(): void {
    if (!this.#isStarted) return;
    cancelAnimationFrame(this.#handle);
    this.#handle = 0;
    this.#isRequested = false;
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
    this.#isRequested = false;
    cancelAnimationFrame(this.#handle);
    this.#handle = 0;
  }
}
