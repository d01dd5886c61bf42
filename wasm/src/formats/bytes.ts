/** Joins text and typed arrays into the bytes of a file. Numbers stand in the machine's byte order. */
export function joinBytes(parts: readonly (string | ArrayBufferView)[]): Uint8Array<ArrayBuffer> {
  const encoder = new TextEncoder();
  const joined = new Uint8Array(parts.reduce((sum, part) => sum + lengthOf(part), 0));
  let position = 0;
  for (const part of parts) {
    if (typeof part === "string") position += encoder.encodeInto(part, joined.subarray(position)).written;
    else {
      joined.set(new Uint8Array(part.buffer, part.byteOffset, part.byteLength), position);
      position += part.byteLength;
    }
  }
  return joined;
}

/** In bytes, of text without a second copy of it: nearly all is ASCII. */
function lengthOf(part: string | ArrayBufferView): number {
  if (typeof part !== "string") return part.byteLength;
  return /[\u0080-\uffff]/.test(part) ? new TextEncoder().encode(part).length : part.length;
}

/** Whether the machine writes the low byte first; file headers say so. */
export const IS_LITTLE_ENDIAN = new Uint8Array(Uint16Array.of(1).buffer)[0] === 1;

/** Unsigned 32-bit numbers as 64-bit ones, in the machine's byte order. */
export function widened(values: ArrayLike<number>): Uint32Array {
  const low = IS_LITTLE_ENDIAN ? 0 : 1;
  const wide = new Uint32Array(2 * values.length);
  for (let i = 0; i < values.length; i++) wide[2 * i + low] = values[i] ?? 0;
  return wide;
}

export function bigEndianDoubles(values: Float64Array): DataView {
  const view = new DataView(new ArrayBuffer(8 * values.length));
  values.forEach((value, i) => view.setFloat64(8 * i, value));
  return view;
}

export function bigEndianInts(values: ArrayLike<number>): DataView {
  const view = new DataView(new ArrayBuffer(4 * values.length));
  for (let i = 0; i < values.length; i++) view.setInt32(4 * i, values[i] ?? 0);
  return view;
}
