/** Text in UTF-16, as some editors and shells of Windows write it, in UTF-8. */
import { joined } from "./bytes.js";

/** Bytes by which UTF-16 is recognized: the byte-order mark, and one more character of ASCII. */
const SNIFFED_BYTES = 4;

/** Returns the name of the encoding; undefined for other files. */
function utf16In([a, b, c, d]: Uint8Array): "utf-16le" | "utf-16be" | undefined {
  if (a === 0xff && b === 0xfe && c !== 0 && d === 0) return "utf-16le";
  if (a === 0xfe && b === 0xff && c === 0 && d !== 0) return "utf-16be";
  return undefined;
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
    const encoding = utf16In(first);
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
