/** Largest time between two frames that counts, in seconds: after a pause of the page, playing goes on where it was. */
const maxFrame = 0.25;

/** Calls back once per frame, or in an interval, with the number of steps that have become due. */
export class Playback {
  readonly #onSteps: (steps: number) => void;
  #speed = 0;
  #frame: number | null = null;
  #before: number | null = null;
  /** Seconds between two calls back; 0 for one per frame. */
  #interval = 0;
  /** Seconds since the last call back. */
  #waited = 0;
  /** Part of a step that is due. */
  #due = 0;

  constructor(onSteps: (steps: number) => void) {
    this.#onSteps = onSteps;
  }

  /** Starts, or changes the speed; in steps per second. `interval`: seconds between two calls back, for stills without motion. */
  start(speed: number, interval = 0): void {
    this.#speed = speed;
    this.#interval = interval;
    if (this.#frame !== null) return;
    this.#before = null;
    this.#waited = 0;
    this.#due = 0;
    this.#request();
  }

  stop(): void {
    if (this.#frame !== null) cancelAnimationFrame(this.#frame);
    this.#frame = null;
  }

  #request(): void {
    const frame = requestAnimationFrame((now) => {
      const seconds = this.#before === null ? 0 : (now - this.#before) / 1000;
      this.#before = now;
      const counted = Math.min(seconds, maxFrame);
      this.#due += this.#speed * counted;
      this.#waited += counted;
      const steps = this.#waited < this.#interval ? 0 : Math.floor(this.#due);
      this.#due -= steps;
      if (steps > 0) {
        this.#waited = 0;
        this.#onSteps(steps);
      }
      // Not before the steps: the view, which they have asked to draw, would draw in every other frame only.
      if (this.#frame === frame) this.#request();
    });
    this.#frame = frame;
  }
}
