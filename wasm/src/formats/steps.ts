/** Long work in steps, between which others run, and the signal of the work is heard. */
import { throwIfCancelled } from "../base/cancelling.js";

/** Between two steps. Among the parts of a file it has no bytes. */
export const BREATH = "";

/** Work that lets others run wherever it yields. */
export type Steps<T> = Generator<typeof BREATH, T, void>;

/** So many rows, nodes or elements are a step: a few milliseconds of work. */
export const STEP = 1 << 12;

/** Longest time without letting others run, in milliseconds. */
const BREATH_MS = 12;

/** Lets others run every few milliseconds, and hears its signal then. */
export class Breather {
  #last = performance.now();
  readonly #signal: AbortSignal | undefined;

  constructor(signal: AbortSignal | undefined) {
    this.#signal = signal;
  }

  get isDue(): boolean {
    return performance.now() - this.#last >= BREATH_MS;
  }

  /** Rejects with a `MesherError` where the signal is aborted. */
  async breathe(): Promise<void> {
    await new Promise((resolve) => setTimeout(resolve));
    throwIfCancelled(this.#signal);
    this.#last = performance.now();
  }
}

/** The result of the work, while others run between its steps. */
export async function inSteps<T>(work: Steps<T>, signal?: AbortSignal): Promise<T> {
  const breather = new Breather(signal);
  for (;;) {
    const step = work.next();
    if (step.done === true) return step.value;
    if (breather.isDue) await breather.breathe();
  }
}

/** Calls `work` with ranges that cover 0 to `count` - 1 in order. */
export function* inRanges(
  count: number,
  work: (begin: number, end: number) => void,
  size = STEP,
): Steps<void> {
  for (let begin = 0; begin < count; begin += size) {
    work(begin, Math.min(begin + size, count));
    yield BREATH;
  }
}

/** What `piece` makes of ranges that cover 0 to `count` - 1 in order. */
export function* inPieces<Piece>(
  count: number,
  piece: (begin: number, end: number) => Piece,
): Generator<Piece, void> {
  for (let begin = 0; begin < count; begin += STEP) yield piece(begin, Math.min(begin + STEP, count));
}

/** Calls `each` with 0 to `count` - 1 in order. */
export function stepwise(count: number, each: (index: number) => void): Steps<void> {
  return inRanges(count, (begin, end) => {
    for (let i = begin; i < end; i++) each(i);
  });
}

/** The first value that passes, by its index, or -1. */
export function* firstOf<T>(values: ArrayLike<T>, test: (value: T) => boolean): Steps<number> {
  for (let begin = 0; begin < values.length; begin += STEP) {
    const end = Math.min(begin + STEP, values.length);
    for (let i = begin; i < end; i++) if (test(values[i] as T)) return i;
    yield BREATH;
  }
  return -1;
}
