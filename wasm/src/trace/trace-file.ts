/** Writing of trace files (docs/TRACE.md). */
import { joined } from "../formats/bytes.js";
import type { TraceHeader } from "./header.js";
import { MAGIC, TRACE_VERSION } from "./layout.js";

/** Bits of a LEB128 byte that hold the number. */
const VARINT_BITS = 7;

/**
 * Returns the file of a recorded run.
 *
 * @param positions x y z of the boundary's nodes.
 * @param events The events as the engine has written them, in pieces of any length.
 */
export function traceFile(
  header: TraceHeader,
  positions: Float64Array,
  events: readonly Uint8Array[],
): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(JSON.stringify(header));
  const begin = new TextEncoder().encode(MAGIC);
  const numbers = new DataView(new ArrayBuffer(positions.byteLength));
  positions.forEach((coordinate, i) => {
    numbers.setFloat64(8 * i, coordinate, true);
  });
  const head = Uint8Array.of(TRACE_VERSION, ...varint(text.length));
  return joined([begin, head, text, new Uint8Array(numbers.buffer), ...events]);
}

function varint(value: number): readonly number[] {
  const base = 1 << VARINT_BITS;
  return value < base ? [value] : [(value % base) | base, ...varint(Math.floor(value / base))];
}
