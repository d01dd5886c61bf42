import { nextTurn, sliceMs } from "../document/slices";

type Transferable = Float64Array<ArrayBuffer> | Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>;

export interface TransferCopy<T> {
  readonly copy: T;
  /** Buffers of the copy, for the transfer list of the message. */
  readonly buffers: ArrayBuffer[];
}

/** Numbers copied between two readings of the clock: at most a few milliseconds, also where new memory is slow. */
const numbersPerLook = 1 << 15;

/**
 * Copies an object whose typed arrays are to be transferred to a worker while the caller keeps its own. It takes one pass
 * over the memory, in slices between which the page responds; a message that copies the arrays takes several, in one task.
 */
export async function copyForTransfer<T extends object>(holder: T): Promise<TransferCopy<T>> {
  const entries = Object.entries(holder).map(([name, value]: [string, unknown]) => ({ name, value }));
  const copies = entries.map(({ name, value }) =>
    isTransferable(value) ? { name, value: sameLength(value), from: value } : { name, value },
  );
  // The task that asks for a copy may have received the result of a run.
  await nextTurn();
  let resumed = performance.now();
  for (const { value, from } of copies) {
    if (!from) continue;
    for (let begin = 0; begin < from.length; begin += numbersPerLook) {
      if (performance.now() - resumed > sliceMs) {
        await nextTurn();
        resumed = performance.now();
      }
      value.set(from.subarray(begin, begin + numbersPerLook), begin);
    }
  }
  return {
    copy: Object.fromEntries(copies.map(({ name, value }) => [name, value])) as T,
    buffers: copies.flatMap(({ value, from }) => (from ? [value.buffer] : [])),
  };
}

function sameLength(array: Transferable): Transferable {
  if (array instanceof Float64Array) return new Float64Array(array.length);
  if (array instanceof Float32Array) return new Float32Array(array.length);
  return new Uint32Array(array.length);
}

function isTransferable(value: unknown): value is Transferable {
  return value instanceof Float64Array || value instanceof Float32Array || value instanceof Uint32Array;
}
