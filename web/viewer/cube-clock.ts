/**
 * What the view cube's library gets in place of three's deprecated clock (see vite.config.ts), which
 * would warn in every visitor's console.
 */
export class Clock {
  #last = performance.now();

  /** Seconds since the last look at it. */
  getDelta(): number {
    const now = performance.now();
    const seconds = (now - this.#last) / 1000;
    this.#last = now;
    return seconds;
  }
}
