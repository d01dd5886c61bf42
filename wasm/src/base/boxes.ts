/** A box that contains a solid. */
export interface Box {
  readonly low: readonly number[];
  readonly high: readonly number[];
}

/** Returns the pairs of boxes that are not apart, as indices, the smaller first. */
export function nearPairs(boxes: readonly Box[]): (readonly [number, number])[] {
  return boxes.flatMap(({ low, high }, i) =>
    boxes.slice(i + 1).flatMap((other, k) => {
      const isApart = low.some((x, axis) => {
        const [from = x, to = x] = [other.low[axis], other.high[axis]];
        return x > to || (high[axis] ?? x) < from;
      });
      return isApart ? [] : [[i, i + 1 + k] as const];
    }),
  );
}
