/** Largest time between two frames that counts, in seconds: after a pause of the page, playing goes on where it was. */
const maxFrame = 0.25;

/** Calls back once per frame with the number of steps that have become due. */
export class Playback {
  readonly #onSteps: (steps: number) => void;
  #speed = 0;
  #frame: number | null = null;
  #before: number | null = null;
  /** Part of a step that is due. */
  #due = 0;

  constructor(onSteps: (steps: number) => void) {
    this.#onSteps = onSteps;
  }

  /** Starts, or changes the speed; in steps per second. */
  start(speed: number): void {
    this.#speed = speed;
    if (this.#frame !== null) return;
    this.#before = null;
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
      this.#due += this.#speed * Math.min(seconds, maxFrame);
      const steps = Math.floor(this.#due);
      this.#due -= steps;
      if (steps > 0) this.#onSteps(steps);
      // Not before the steps: the view, which they have asked to draw, would draw in every other frame only.
      if (this.#frame === frame) this.#request();
    });
    this.#frame = frame;
  }
}
