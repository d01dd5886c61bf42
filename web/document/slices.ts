/** Longest time without yielding to the page, in milliseconds. */
export const sliceMs = 8;
/** Number of steps between two readings of the clock. */
const stepsPerLook = 256;

/** Resolves after the page has handled its pending events. */
export const nextTurn = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));

/** Calls `step` for 0, 1, 2 … `count` - 1, and yields to the page in between. Rejects if it is aborted. */
export async function forEachInSlices(
  count: number,
  step: (index: number) => void,
  signal?: AbortSignal,
): Promise<void> {
  let resumed = performance.now();
  for (let i = 0; i < count; ++i) {
    if (i % stepsPerLook === stepsPerLook - 1 && performance.now() - resumed > sliceMs) {
      await nextTurn();
      signal?.throwIfAborted();
      resumed = performance.now();
    }
    step(i);
  }
}
