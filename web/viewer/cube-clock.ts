/**
 * Replaces three's deprecated clock, which prints warnings, for the library of the view cube (see
 * vite.config.mjs).
 */
export class Clock {
  #last = performance.now();

  /** Restarts the measurement. */
  start(): void {
    this.#last = performance.now();
  }

  /** Returns the seconds since the last call. */
  getDelta(): number {
    const now = performance.now();
    const seconds = (now - this.#last) / 1000;
    this.#last = now;
    return seconds;
  }
}
