export interface TransferCopy<T> {
  readonly copy: T;
  /** Buffers of the copy, for the transfer list of the message. */
  readonly buffers: ArrayBuffer[];
}

/**
 * Copies an object whose typed arrays are to be transferred to a worker while the caller keeps its own. This takes
 * one pass over the memory; a message that copies the arrays itself takes several.
 */
export function copyForTransfer<T extends object>(holder: T): TransferCopy<T> {
  const buffers: ArrayBuffer[] = [];
  const entries = Object.entries(holder).map(([name, value]: [string, unknown]): [string, unknown] => {
    if (!isTransferable(value)) return [name, value];
    const copy = value.slice();
    buffers.push(copy.buffer);
    return [name, copy];
  });
  return { copy: Object.fromEntries(entries) as T, buffers };
}

function isTransferable(
  value: unknown,
): value is Float64Array<ArrayBuffer> | Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer> {
  return value instanceof Float64Array || value instanceof Float32Array || value instanceof Uint32Array;
}
