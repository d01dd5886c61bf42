import type { Phase } from "../generated/constants.js";
import type { Seconds } from "../mesh/report.js";

/** Wall-clock time of a run, by phase. */
export class RunClock {
  readonly #started = performance.now();
  readonly #milliseconds: Record<Phase, number> = {
    check: 0,
    sides: 0,
    surface: 0,
    volume: 0,
    optimize: 0,
    verify: 0,
  };

  /** Adds the time of a call that began in this phase. */
  book(phase: Phase, milliseconds: number): void {
    this.#milliseconds[phase] += milliseconds;
  }

  elapsedSeconds(): number {
    return (performance.now() - this.#started) / 1000;
  }

  seconds(): Seconds {
    const { check, sides, surface, volume, optimize, verify } = this.#milliseconds;
    return {
      total: this.elapsedSeconds(),
      check: (check + verify) / 1000,
      sides: sides / 1000,
      surface: surface / 1000,
      volume: volume / 1000,
      optimize: optimize / 1000,
    };
  }
}
