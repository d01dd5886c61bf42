/** Text in bytes: decoding it, and finding sequences. */

/** Length of the byte-order mark in UTF-8. */
export const MARK_BYTES = 3;

/** Returns whether a byte-order mark begins at `at`. */
export function startsWithMark(bytes: Uint8Array, at: number): boolean {
  return bytes[at] === 0xef && bytes[at + 1] === 0xbb && bytes[at + 2] === 0xbf;
}

const utf8 = new TextDecoder("utf-8", { ignoreBOM: true, fatal: true });
/** The name stands for the code page 1252 of Windows, which contains the printable characters of Latin-1. */
const latin1 = new TextDecoder("latin1");

/** Decodes UTF-8, or Latin-1 if the bytes are not UTF-8: older programs write names in it. */
export function textOf(bytes: Uint8Array): string {
  try {
    return utf8.decode(bytes);
  } catch {
    return latin1.decode(bytes);
  }
}

/** Returns the index of the next occurrence of `sequence` from `from` on, or -1. */
export function indexOf(bytes: Uint8Array, sequence: Uint8Array, from: number): number {
  const first = sequence[0] ?? 0;
  for (let at = bytes.indexOf(first, from); at >= 0; at = bytes.indexOf(first, at + 1)) {
    if (sequence.every((byte, i) => bytes[at + i] === byte)) return at;
  }
  return -1;
}
