/** Zip files, compressed while their parts are made. */
import { Zip, ZipDeflate } from "fflate";

import { piecesIn, type Part } from "./bytes.js";
import type { FileParts } from "./file-format.js";
import { BREATH } from "./steps.js";

/** So that a zip has the same bytes whenever it is made; the first day that a zip can name. */
const MADE = new Date(1980, 0, 1);
/** Fast; the text of a mesh shrinks to a fourth even so. */
const LEVEL = 1;
/** As much is compressed in one step. */
const STEP_BYTES = 1 << 16;

/** The bytes of a zip of these files, of which never more is held than is being compressed. */
export function* zipped(files: Iterable<FileParts>): Generator<Part, void> {
  let made: Uint8Array[] = [];
  const zip = new Zip((_, bytes) => made.push(bytes));
  for (const { fileName, parts } of files) {
    const file = new ZipDeflate(fileName, { level: LEVEL });
    file.mtime = MADE;
    zip.add(file);
    for (const piece of piecesIn(parts)) {
      for (let at = 0; at < piece.length; at += STEP_BYTES) file.push(piece.subarray(at, at + STEP_BYTES));
      yield BREATH;
      yield* made;
      made = [];
    }
    file.push(new Uint8Array(), true);
  }
  zip.end();
  yield* made;
}
