/** Writes zip files; the content is compressed while it is generated. */
import { Zip, ZipDeflate } from "fflate";
import { PAUSE } from "../base/steps.js";
import { type Part, piecesIn } from "./bytes.js";
import type { FileParts } from "./file-format.js";

/** Fixed date, so that equal contents give equal bytes: the first day that a zip can store. */
const MADE = new Date(1980, 0, 1);
/** Fast, and still compresses the text of a mesh to a quarter. */
const LEVEL = 1;
/** Number of bytes compressed per slice. */
const STEP_BYTES = 1 << 16;

/** Returns the bytes of a zip of these files; only the part being compressed is in memory. */
export function* zipped(files: Iterable<FileParts>): Generator<Part, void> {
  let made: Uint8Array[] = [];
  const zip = new Zip((_, bytes) => made.push(bytes));
  for (const { fileName, parts } of files) {
    const file = new ZipDeflate(fileName, { level: LEVEL });
    file.mtime = MADE;
    zip.add(file);
    for (const piece of piecesIn(parts)) {
      for (let at = 0; at < piece.length; at += STEP_BYTES) file.push(piece.subarray(at, at + STEP_BYTES));
      yield PAUSE;
      yield* made;
      made = [];
    }
    file.push(new Uint8Array(), true);
  }
  zip.end();
  yield* made;
}
