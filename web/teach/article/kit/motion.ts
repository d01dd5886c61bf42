/** Motion on demand: eased, and a jump if the reader prefers reduced motion. */

export const isCalm = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

export const clamp = (value: number, min: number, max: number): number => Math.min(max, Math.max(min, value));

/** Returns 0 to 1 with a soft beginning and end. */
export function ease(t: number): number {
  const u = clamp(t, 0, 1);
  return u * u * (3 - 2 * u);
}

/** One motion at a time: a new one ends the motion before it. */
export class Motion {
  #present = 0;

  /** Ends the motion where it is. */
  stop(): void {
    cancelAnimationFrame(this.#present);
    this.#present = 0;
  }

  get isMoving(): boolean {
    return this.#present !== 0;
  }

  /** Calls `act` with 0 to 1, eased, over a time in milliseconds; only with 1 in reduced motion. */
  run(milliseconds: number, act: (t: number) => void, done: () => void = () => undefined): void {
    if (isCalm()) {
      this.stop();
      act(1);
      done();
      return;
    }
    let elapsed = 0;
    this.frames((seconds) => {
      elapsed += seconds * 1000;
      act(ease(elapsed / milliseconds));
      return elapsed < milliseconds;
    }, done);
  }

  /** Calls `act` in each frame with the seconds since the one before, until it returns false. */
  frames(act: (seconds: number) => boolean, done: () => void = () => undefined): void {
    this.stop();
    let last = performance.now();
    const frame = (now: number): void => {
      const seconds = clamp((now - last) / 1000, 0, 0.1);
      last = now;
      const goesOn = act(seconds);
      if (goesOn) this.#present = requestAnimationFrame(frame);
      else {
        this.#present = 0;
        done();
      }
    };
    this.#present = requestAnimationFrame(frame);
  }
}
