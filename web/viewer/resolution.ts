/** Shares of the full resolution in which the view is drawn while something moves. Lower ones take no less time. */
export const scales = [1, 0.7, 0.5] as const;
/** Time between frames from which the view is drawn in a lower resolution, in milliseconds. */
const slowMs = 40;
/** Time between frames that is aimed at. */
const goalMs = 33;
/** Time between frames at which a higher resolution is tried: about that of a screen. */
const fastMs = 18;
/** A longer time is a pause of the page, and says nothing about drawing. */
const pauseMs = 2000;
/** Number of times that are averaged: without a graphics processor, frames often come in pairs, one soon after the other. */
const averaged = 4;
/** If a lower resolution takes at least this share of the time, it is not pixels that take it. */
const useless = 0.95;
/**
 * Number of averages after which a lower resolution that did not help is tried once more in a motion: other work on the
 * machine may have been the reason.
 */
const retryAfter = 6;
const maxTries = 2;

/** Chooses the resolution of a moving view from the times between its frames. */
export class Resolution {
  #level = 0;
  #times: number[] = [];
  /** The level before the last step down, and its average time. */
  #above: { readonly level: number; readonly average: number } | null = null;
  /** Number of averages until a lower resolution may be tried, and how often one was useless. */
  #waits = 0;
  #failures = 0;
  #canRise = true;

  /** Share of the full resolution, for a view that moves. */
  get scale(): number {
    return scales[this.#level] ?? 1;
  }

  /** Takes the time between two frames of a motion into account, in milliseconds. */
  add(ms: number): void {
    if (ms > pauseMs) return;
    this.#times.push(ms);
    if (this.#times.length < averaged) return;
    const average = this.#times.reduce((sum, time) => sum + time, 0) / averaged;
    this.#times = [];
    const above = this.#above;
    this.#above = null;
    this.#waits = Math.max(0, this.#waits - 1);
    if (above && average > useless * above.average) {
      this.#level = above.level;
      this.#waits = ++this.#failures < maxTries ? retryAfter : Infinity;
    } else if (average > slowMs) {
      this.#sink(average);
    } else if (average < fastMs && this.#level > 0 && this.#canRise) {
      --this.#level;
    }
  }

  /** Ends a motion: the next one begins with the same resolution. */
  rest(): void {
    this.#times = [];
    this.#above = null;
    this.#waits = 0;
    this.#failures = 0;
    this.#canRise = true;
  }

  /** Lowers the resolution as far as the time demands, which is about proportional to the number of pixels. */
  #sink(average: number): void {
    if (this.#waits > 0 || this.#level === scales.length - 1) return;
    const wanted = this.scale * Math.sqrt(goalMs / average);
    this.#above = { level: this.#level, average };
    const first = scales.findIndex((scale) => scale <= wanted);
    this.#level = Math.max(this.#level + 1, first < 0 ? scales.length - 1 : first);
    // It was raised too far, or the scene has become larger.
    this.#canRise = false;
  }
}
