import { inPieces } from "../base/steps.js";

/**
 * Content of a file, in order. Rows of numbers are generated while they are written; numeric arrays are in the byte
 * order of the machine.
 */
export type Part = string | ArrayBufferView | Iterable<Part>;

/** Yields the bytes of the parts, piece by piece. */
export function* piecesIn(parts: Iterable<Part>): Generator<Uint8Array, void> {
  const encoder = new TextEncoder();
  for (const part of parts) {
    if (typeof part === "string") yield encoder.encode(part);
    else if (ArrayBuffer.isView(part)) yield new Uint8Array(part.buffer, part.byteOffset, part.byteLength);
    else yield* piecesIn(part);
  }
}

export function joined(pieces: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(pieces.reduce((sum, { length }) => sum + length, 0));
  let end = 0;
  for (const piece of pieces) {
    all.set(piece, end);
    end += piece.length;
  }
  return all;
}

/** Whether the machine stores the low byte first; file headers state it. */
export const IS_LITTLE_ENDIAN = new Uint8Array(Uint16Array.of(1).buffer)[0] === 1;

/** Returns unsigned 32-bit numbers as 64-bit numbers, in the byte order of the machine. */
export function widened(values: ArrayLike<number>): Uint32Array {
  const low = IS_LITTLE_ENDIAN ? 0 : 1;
  const wide = new Uint32Array(2 * values.length);
  for (let i = 0; i < values.length; i++) wide[2 * i + low] = values[i] ?? 0;
  return wide;
}

export function bigEndianDoubles(values: Float64Array): Part {
  return inPieces(values.length, (begin, end) => {
    const view = new DataView(new ArrayBuffer(8 * (end - begin)));
    for (let i = begin; i < end; i++) view.setFloat64(8 * (i - begin), values[i] ?? 0);
    return view;
  });
}

/** Writes `values` as 32-bit integers. `first` is added to each, for nodes numbered from 1. */
export function bigEndianInts(values: ArrayLike<number>, first = 0): Part {
  return inPieces(values.length, (begin, end) => {
    const view = new DataView(new ArrayBuffer(4 * (end - begin)));
    for (let i = begin; i < end; i++) view.setInt32(4 * (i - begin), (values[i] ?? 0) + first);
    return view;
  });
}
