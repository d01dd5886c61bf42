/** Long work that can be paused: generators that yield between two slices. */

/** Yielded between two slices. It is an empty part of a file. */
export const PAUSE = "";

/** Work that may be paused wherever it yields. */
export type Steps<T> = Generator<typeof PAUSE, T, void>;

/** Number of rows, nodes or elements per slice: a few milliseconds of work. */
export const STEP = 1 << 12;

/** Does the work without a pause and returns its result. */
export function withoutPause<T>(work: Steps<T>): T {
  for (;;) {
    const step = work.next();
    if (step.done === true) return step.value;
  }
}

/** Calls `work` with consecutive ranges that cover 0 to `count` - 1. */
export function* inRanges(
  count: number,
  work: (begin: number, end: number) => void,
  size = STEP,
): Steps<void> {
  for (let begin = 0; begin < count; begin += size) {
    work(begin, Math.min(begin + size, count));
    yield PAUSE;
  }
}

/** Yields the result of `piece` for consecutive ranges that cover 0 to `count` - 1. */
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

/** Returns the index of the first value that passes the test, or -1. */
export function* firstOf<T>(values: ArrayLike<T>, test: (value: T) => boolean): Steps<number> {
  for (let begin = 0; begin < values.length; begin += STEP) {
    const end = Math.min(begin + STEP, values.length);
    for (let i = begin; i < end; i++) if (test(values[i] as T)) return i;
    yield PAUSE;
  }
  return -1;
}
