/** Text in bytes: decoding it, and finding sequences. */

/** Length of the byte-order mark in UTF-8. */
export const MARK_BYTES = 3;

/** Returns whether a byte-order mark begins at `at`. */
export function startsWithMark(bytes: Uint8Array, at: number): boolean {
  return bytes[at] === 0xef && bytes[at + 1] === 0xbb && bytes[at + 2] === 0xbf;
}

/** Decodes UTF-8. Invalid bytes become replacement characters, so that the text is empty only if there are no bytes. */
export function textOf(bytes: Uint8Array): string {
  return new TextDecoder("utf-8", { ignoreBOM: true }).decode(bytes);
}

/** Returns the index of the next occurrence of `sequence` from `from` on, or -1. */
export function indexOf(bytes: Uint8Array, sequence: Uint8Array, from: number): number {
  const first = sequence[0] ?? 0;
  for (let at = bytes.indexOf(first, from); at >= 0; at = bytes.indexOf(first, at + 1)) {
    if (sequence.every((byte, i) => bytes[at + i] === byte)) return at;
  }
  return -1;
}
