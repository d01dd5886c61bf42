/** Replaces three's deprecated clock for the view cube's library (see vite.config.ts): that one warns in the console. */
export class Clock {
  #last = performance.now();

  /** Returns the seconds since the last call. */
  getDelta(): number {
    const now = performance.now();
    const seconds = (now - this.#last) / 1000;
    this.#last = now;
    return seconds;
  }
}
