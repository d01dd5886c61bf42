/** Text in UTF-16, as some editors and shells of Windows write it, in UTF-8. */
import { joined } from "./bytes.js";

/** Number of bytes by which UTF-16 without a byte-order mark is recognized; the header of a binary STL file is shorter. */
const SNIFFED_BYTES = 256;
/** Fewer characters do not tell. */
const MIN_BYTES = 16;

type Encoding = "utf-16le" | "utf-16be";

/** Returns the name of the encoding; undefined for other files. */
function utf16In(head: Uint8Array): Encoding | undefined {
  const [a, b, c, d] = head;
  if (a === 0xff && b === 0xfe && c !== 0 && d === 0) return "utf-16le";
  if (a === 0xfe && b === 0xff && c === 0 && d !== 0) return "utf-16be";
  if (head.length < MIN_BYTES) return undefined;
  if (isAsciiBeside(head, 1)) return "utf-16le";
  return isAsciiBeside(head, 0) ? "utf-16be" : undefined;
}

/** Returns whether every second byte, from `first` on, is zero, and the others are text in ASCII. */
function isAsciiBeside(head: Uint8Array, first: 0 | 1): boolean {
  return head.every((byte, at) => {
    if (at % 2 === first) return byte === 0;
    return (byte >= 0x20 && byte < 0x7f) || (byte >= 0x09 && byte <= 0x0d);
  });
}

/** Yields the pieces of a file; if it is text in UTF-16, in UTF-8. */
export async function* inUtf8(pieces: AsyncGenerator<Uint8Array, void>): AsyncGenerator<Uint8Array, void> {
  try {
    let first = new Uint8Array();
    while (first.length < SNIFFED_BYTES) {
      const next = await pieces.next();
      if (next.done === true) break;
      first = joined([first, next.value]);
    }
    const encoding = utf16In(first.subarray(0, SNIFFED_BYTES));
    if (encoding === undefined) {
      yield first;
      yield* pieces;
      return;
    }
    const decoder = new TextDecoder(encoding);
    const encoder = new TextEncoder();
    yield encoder.encode(decoder.decode(first, { stream: true }));
    for await (const piece of pieces) yield encoder.encode(decoder.decode(piece, { stream: true }));
    yield encoder.encode(decoder.decode());
  } finally {
    await pieces.return();
  }
}
