/** Converts XML files in other encodings to UTF-8, in which tags are found by their bytes. */
import { joined } from "./bytes.js";
import { indexOf } from "./text-bytes.js";

/** Bytes that are decoded at once: a large file may exceed the longest possible string. */
const PIECE_BYTES = 1 << 20;
/** The declaration is among the first bytes of a file. */
const DECLARATION_BYTES = 200;
const DECLARED = /^\s*<\?xml[^>]*\sencoding\s*=\s*["']([\w.:-]+)["']/;
const LATIN1 = /^(iso-?8859-?1|iso_8859-1(:1987)?|latin-?1|l1|windows-?1252|cp-?1252)$/i;
/** Binary data of VTK begins after this tag. */
const BINARY_DATA = new TextEncoder().encode("<AppendedData");

/**
 * Returns an XML file in UTF-8: the given bytes, unless a byte-order mark, zeros in the first characters or the declaration
 * state that they are UTF-16 or Latin-1 (XML 1.0, appendix F). The appended data of a VTK file in Latin-1 stay as they are. O(n).
 */
export function xmlInUtf8(bytes: Uint8Array): Uint8Array {
  const [a, b, c, d] = bytes;
  if ((a === 0xff && b === 0xfe) || (a === LESS && b === 0 && c !== 0 && d === 0))
    return recoded(bytes, "utf-16le");
  if ((a === 0xfe && b === 0xff) || (a === 0 && b === LESS && c === 0 && d !== 0))
    return recoded(bytes, "utf-16be");
  const begin = new TextDecoder("latin1").decode(bytes.subarray(0, DECLARATION_BYTES));
  if (!LATIN1.test(DECLARED.exec(begin)?.[1] ?? "")) return bytes;
  const data = indexOf(bytes, BINARY_DATA, 0);
  return data < 0
    ? recoded(bytes, "latin1")
    : joined([recoded(bytes.subarray(0, data), "latin1"), bytes.subarray(data)]);
}

const LESS = 60;

function recoded(bytes: Uint8Array, encoding: "utf-16le" | "utf-16be" | "latin1"): Uint8Array {
  const decoder = new TextDecoder(encoding);
  const encoder = new TextEncoder();
  const pieces: Uint8Array[] = [];
  for (let at = 0; at < bytes.length; at += PIECE_BYTES) {
    const piece = bytes.subarray(at, at + PIECE_BYTES);
    pieces.push(encoder.encode(decoder.decode(piece, { stream: at + PIECE_BYTES < bytes.length })));
  }
  return joined(pieces);
}
