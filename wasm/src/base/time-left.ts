/** Time before an estimate is made, in seconds, and the least progress for it: the first steps of a run say little. */
const minSeconds = 3;
const minFraction = 0.2;
/** Share of the elapsed time whose progress counts as that of the beginning. */
const beginning = 0.5;
/** Addition to a time left for which nothing has been done yet: later stages tend to be slower than the reports say. */
const margin = 0.25;
/** Weight of a new estimate beside the one before, if it is later, and if it is earlier. */
const freshness = { later: 0.25, earlier: 0.15 } as const;

interface Report {
  readonly fraction: number;
  readonly seconds: number;
}

/** Estimates how long a run still takes, from the progress that it reports. It rather says too much than too little. */
export class TimeLeft {
  /** Reports of the second half of the elapsed time, and the last one before it. */
  #reports: readonly Report[] = [{ fraction: 0, seconds: 0 }];
  /** Second at which the run would end by the estimate; null before there is one. */
  #end: number | null = null;

  /** Takes a report of the progress, 0 to 1, and returns the time left in seconds; null if it is not known. */
  add(fraction: number, elapsedSeconds: number): number | null {
    const all = [...this.#reports, { fraction, seconds: elapsedSeconds }];
    const first = all.findLastIndex(({ seconds }) => seconds <= beginning * elapsedSeconds);
    this.#reports = all.slice(Math.max(0, first));
    if (elapsedSeconds < minSeconds || fraction < minFraction || fraction >= 1) return null;
    const end =
      elapsedSeconds + (1 + margin * (1 - fraction)) * this.#timeAtSlowestRate(fraction, elapsedSeconds);
    // One stage is faster than another: a mean over the reports keeps the number from jumping.
    const before = this.#end ?? end;
    this.#end = before + (end > before ? freshness.later : freshness.earlier) * (end - before);
    return Math.max(0, this.#end - elapsedSeconds);
  }

  /** Time for the remaining work at the mean rate of the whole run or of its second half, whichever is lower. */
  #timeAtSlowestRate(fraction: number, seconds: number): number {
    const perFraction = ([from]: readonly Report[]): number => {
      const done = fraction - (from?.fraction ?? 0);
      return done > 0 ? (seconds - (from?.seconds ?? 0)) / done : 0;
    };
    return (1 - fraction) * Math.max(seconds / fraction, perFraction(this.#reports));
  }
}

/** Numbers of seconds to which a time is rounded, up to a minute. */
const steps = [1, 2, 3, 5, 10, 15, 20, 30, 45, 60] as const;

/** Returns a time in seconds as a round number of seconds or minutes: an estimate is no better. */
export function roundTime(seconds: number): { readonly value: number; readonly unit: "s" | "min" } {
  const step = steps.find((value) => seconds <= value * 1.15);
  if (step !== undefined && step < 60) return { value: step, unit: "s" };
  return { value: Math.max(1, Math.round(seconds / 60)), unit: "min" };
}
