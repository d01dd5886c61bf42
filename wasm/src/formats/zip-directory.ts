/** The list of files at the end of a zip file (PKWARE, APPNOTE 4.3.12), and the checksums in it, which fflate does not verify. */
import { strFromU8 } from "fflate";

const ENTRY = 0x02014b50;
const END = 0x06054b50;
const END_BYTES = 22;
const MAX_COMMENT = 0xffff;
const FLAGS = 8;
/** Bit of the flags: the name is UTF-8. */
const IS_UTF8 = 1 << 11;
const CHECKSUM = 16;
const NAME_LENGTH = 28;
/** Lengths of the name, the extra field and the comment, which follow an entry. */
const LENGTHS = [NAME_LENGTH, 30, 32];

/** Length of an entry without its name, extra field and comment. */
export const ENTRY_BYTES = 46;

/** Returns where the entries of the central directory begin. */
export function entriesOf(view: DataView): number[] {
  let end = view.byteLength - END_BYTES;
  const first = Math.max(0, end - MAX_COMMENT);
  while (end >= first && view.getUint32(end, true) !== END) end--;
  if (end < first) return [];
  const entries: number[] = [];
  let at = view.getUint32(end + 16, true);
  while (at + ENTRY_BYTES <= end && view.getUint32(at, true) === ENTRY) {
    entries.push(at);
    at += ENTRY_BYTES + LENGTHS.reduce((sum, field) => sum + view.getUint16(at + field, true), 0);
  }
  return entries;
}

/** Returns whether the unpacked bytes of a file in a zip file have the checksum that its list states. */
export function hasStatedChecksum(zip: Uint8Array, name: string, bytes: Uint8Array): boolean {
  const view = new DataView(zip.buffer, zip.byteOffset, zip.byteLength);
  const nameAt = (entry: number): string => {
    const begin = entry + ENTRY_BYTES;
    const isLatin1 = (view.getUint16(entry + FLAGS, true) & IS_UTF8) === 0;
    return strFromU8(zip.subarray(begin, begin + view.getUint16(entry + NAME_LENGTH, true)), isLatin1);
  };
  const entry = entriesOf(view).find((at) => nameAt(at) === name);
  return entry !== undefined && view.getUint32(entry + CHECKSUM, true) === crc32(bytes);
}

/** Remainders of the polynomial of CRC-32 (ISO 3309), by byte. */
const REMAINDERS = Uint32Array.from({ length: 256 }, (_, byte) => {
  let remainder = byte;
  for (let bit = 0; bit < 8; bit++) remainder = (remainder >>> 1) ^ (remainder & 1 ? 0xedb88320 : 0);
  return remainder;
});

function crc32(bytes: Uint8Array): number {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = (sum >>> 8) ^ (REMAINDERS[(sum ^ byte) & 0xff] ?? 0);
  return (sum ^ 0xffffffff) >>> 0;
}
