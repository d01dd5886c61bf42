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
 * Copies an object whose typed arrays, and those in its maps, are to be transferred to a worker while the caller keeps its own. The arrays are copied in
 * slices between which the page responds; a message would copy them in one task. They must not change before the promise resolves.
 */
export async function copyForTransfer<T extends object>(holder: T): Promise<TransferCopy<T>> {
  const copied: [name: string, value: unknown][] = [];
  const buffers: ArrayBuffer[] = [];
  // The task that asks for a copy may have received the result of a run.
  await nextTurn();
  let resumed = performance.now();
  const letPageRespond = async (): Promise<void> => {
    if (performance.now() - resumed <= sliceMs) return;
    await nextTurn();
    resumed = performance.now();
  };
  for (const [name, value] of Object.entries(holder) as [string, unknown][]) {
    if (value instanceof Map) {
      const part = await copyOfMap(value as ReadonlyMap<unknown, unknown>);
      copied.push([name, part.copy]);
      buffers.push(...part.buffers);
      continue;
    }
    if (!isTransferable(value)) {
      copied.push([name, value]);
      continue;
    }
    await letPageRespond();
    const copy = sameLength(value);
    for (let begin = 0; begin < value.length; begin += numbersPerLook) {
      await letPageRespond();
      copy.set(value.subarray(begin, begin + numbersPerLook), begin);
    }
    copied.push([name, copy]);
    buffers.push(copy.buffer);
  }
  return { copy: Object.fromEntries(copied) as T, buffers };
}

/** Copies a map in the same way, with the typed arrays that its values hold. */
async function copyOfMap(map: ReadonlyMap<unknown, unknown>): Promise<TransferCopy<Map<unknown, unknown>>> {
  const copy = new Map<unknown, unknown>();
  const buffers: ArrayBuffer[] = [];
  for (const [key, value] of map) {
    const isHolder = typeof value === "object" && value !== null && Object.values(value).some(isTransferable);
    const part = isHolder ? await copyForTransfer(value) : { copy: value, buffers: [] };
    copy.set(key, part.copy);
    buffers.push(...part.buffers);
  }
  return { copy, buffers };
}

function sameLength(array: Transferable): Transferable {
  if (array instanceof Float64Array) return new Float64Array(array.length);
  if (array instanceof Float32Array) return new Float32Array(array.length);
  return new Uint32Array(array.length);
}

function isTransferable(value: unknown): value is Transferable {
  return value instanceof Float64Array || value instanceof Float32Array || value instanceof Uint32Array;
}
