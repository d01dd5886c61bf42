/**
 * Prepares zip files for fflate, which reads ZIP64 sizes of entries only if the file has a ZIP64 end record. Writers that do
 * not know the size of an entry beforehand use ZIP64 for the entry alone, as the specification permits (PKWARE, APPNOTE
 * 4.5.3).
 */
import { ENTRY_BYTES, entriesOf } from "./zip-directory.js";

/** Value of a 32-bit field whose number is in the ZIP64 extra field. */
const ELSEWHERE = 0xffffffff;
/** Identifier of the ZIP64 extra field. */
const ZIP64 = 1;
/** Where the original size, the packed size and the offset are in an entry, in the order of the extra field. */
const FIELDS = [24, 20, 42];

/** Returns the file with its ZIP64 sizes and offsets below 2^32 in the usual fields; the file itself if it has none. */
export function withShortSizes(file: Uint8Array): Uint8Array {
  const given = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const entries = entriesOf(given).filter((at) =>
    FIELDS.some((field) => given.getUint32(at + field, true) === ELSEWHERE),
  );
  if (entries.length === 0) return file;
  const copy = new Uint8Array(file);
  const view = new DataView(copy.buffer);
  for (const at of entries) shorten(view, at);
  return copy;
}

/** Copies the numbers of the ZIP64 extra field of an entry to its fields, if they fit. */
function shorten(view: DataView, entry: number): void {
  const begin = entry + ENTRY_BYTES + view.getUint16(entry + 28, true);
  const end = Math.min(begin + view.getUint16(entry + 30, true), view.byteLength);
  for (let at = begin; at + 4 <= end; at += 4 + view.getUint16(at + 2, true)) {
    if (view.getUint16(at, true) !== ZIP64) continue;
    let value = at + 4;
    for (const field of FIELDS) {
      if (view.getUint32(entry + field, true) !== ELSEWHERE || value + 8 > end) continue;
      if (view.getUint32(value + 4, true) === 0)
        view.setUint32(entry + field, view.getUint32(value, true), true);
      value += 8;
    }
    return;
  }
}
