/** Work between two looks at the page, in milliseconds. */
export const sliceMs = 8;
/** Steps between two looks at the clock. */
const stepsPerLook = 256;

/** Resolves once the page has done what was waiting. */
export const nextTurn = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));

/** Calls `step` for 0, 1, 2 … `count` - 1, and lets the page go on in between. */
export async function forEachInSlices(count: number, step: (index: number) => void): Promise<void> {
  let resumed = performance.now();
  for (let i = 0; i < count; ++i) {
    if (i % stepsPerLook === stepsPerLook - 1 && performance.now() - resumed > sliceMs) {
      await nextTurn();
      resumed = performance.now();
    }
    step(i);
  }
}
