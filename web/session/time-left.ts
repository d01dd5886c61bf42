/** Time before an estimate is made, in seconds, and the least progress for it: the first steps of a run say little. */
const minSeconds = 2;
const minFraction = 0.04;
/** Weight of a new estimate beside the one before. */
const freshness = 0.25;

/** Estimates how long a run still takes, from the progress that it reports. */
export class TimeLeft {
  /** Second at which the run would end by the estimate; null before there is one. */
  #end: number | null = null;

  /** Takes a report of the progress, 0 to 1, and returns the time left in seconds; null if it is not known. */
  add(fraction: number, elapsedSeconds: number): number | null {
    if (elapsedSeconds < minSeconds || fraction < minFraction || fraction >= 1) return null;
    const end = elapsedSeconds / fraction;
    // One stage is faster than another: a mean over the reports keeps the number from jumping.
    this.#end = this.#end === null ? end : this.#end + freshness * (end - this.#end);
    return Math.max(0, this.#end - elapsedSeconds);
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
