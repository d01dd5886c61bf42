/** Objects with typed arrays, ready to be posted to a worker. */
export interface HandedOver<T> {
  readonly copy: T;
  /** To be transferred along with the copy. */
  readonly buffers: ArrayBuffer[];
}

/**
 * A copy of an object whose typed arrays are to be transferred, while the caller keeps its own: one pass over
 * the memory, where a message that copies by itself takes several.
 */
export function handedOver<T extends object>(holder: T): HandedOver<T> {
  const buffers: ArrayBuffer[] = [];
  const entries = Object.entries(holder).map(([name, value]: [string, unknown]): [string, unknown] => {
    if (!(value instanceof Float64Array || value instanceof Uint32Array)) return [name, value];
    const copy = value.slice();
    buffers.push(copy.buffer);
    return [name, copy];
  });
  return { copy: Object.fromEntries(entries) as T, buffers };
}

/** Why a worker has failed, from its event "error". */
export function workerFailure(event: Event): string {
  return event instanceof ErrorEvent ? event.message : "A part of the app could not be loaded";
}
