/** Runs long work in slices: other work can run between them, and a cancellation takes effect. */
import type { Steps } from "../base/steps.js";
import { throwIfCancelled } from "./cancelling.js";

/** Longest time without yielding, in milliseconds. */
const MAX_SLICE_MS = 12;

/** Yields to other work every few milliseconds and then checks for cancellation. */
export class Yielder {
  #last = performance.now();
  readonly #signal: AbortSignal | undefined;

  constructor(signal: AbortSignal | undefined) {
    this.#signal = signal;
  }

  get isDue(): boolean {
    return performance.now() - this.#last >= MAX_SLICE_MS;
  }

  /** Lets pending timers and messages run. Rejects with a `MesherError` if the signal is aborted. */
  async yield(): Promise<void> {
    await new Promise((resolve) => setTimeout(resolve));
    throwIfCancelled(this.#signal);
    this.#last = performance.now();
  }
}

/** Returns the result of the work; other work may run between its slices. `onPause` is called before each pause. */
export async function inSteps<T>(work: Steps<T>, signal?: AbortSignal, onPause?: () => void): Promise<T> {
  const yielder = new Yielder(signal);
  for (;;) {
    const step = work.next();
    if (step.done === true) return step.value;
    if (!yielder.isDue) continue;
    onPause?.();
    await yielder.yield();
  }
}

/** Bytes whose copy takes some milliseconds. */
const MANY_BYTES = 4_000_000;

/**
 * Returns a promise that lets pending timers and messages run if the arrays are large, because the message that follows
 * copies them once more; undefined if they are small.
 */
export function pauseAfterCopy(...arrays: readonly ArrayBufferView[]): Promise<void> | undefined {
  const bytes = arrays.reduce((sum, { byteLength }) => sum + byteLength, 0);
  return bytes > MANY_BYTES ? new Promise((resolve) => setTimeout(resolve)) : undefined;
}
