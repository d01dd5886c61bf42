/** A spool for large files, in Node: the first bytes stay in memory, the others are in a temporary file. */
import { randomUUID } from "node:crypto";
import { closeSync, openSync, readSync, rmSync, writeSync } from "node:fs";
import path from "node:path";
import { memorySpool, type Spool } from "./spool.js";

/** Bytes that stay in memory. */
const MAX_HELD_BYTES = 1 << 24;
/** Bytes read at once. */
const PIECE_BYTES = 1 << 20;

/** Returns a spool whose file, if it needs one, is in the folder. */
export function fileSpool(folder: string): Spool {
  const held = memorySpool();
  let heldBytes = 0;
  let file: Spool | undefined;
  return {
    add(bytes) {
      if (file === undefined && heldBytes + bytes.length > MAX_HELD_BYTES) file = openedSpool(folder);
      if (file !== undefined) return file.add(bytes);
      heldBytes += bytes.length;
      held.add(bytes);
    },
    *take(count) {
      const fromHeld = Math.min(count, heldBytes);
      heldBytes -= fromHeld;
      yield* held.take(fromHeld);
      if (file !== undefined) yield* file.take(count - fromHeld);
    },
    close() {
      held.close();
      file?.close();
    },
  };
}

function openedSpool(folder: string): Spool {
  const name = path.join(folder, `.${randomUUID()}.spool`);
  const descriptor = openSync(name, "wx+", 0o600);
  // Most systems keep a removed file while it is open: a process that is killed leaves nothing behind.
  const isRemoved = remove(name);
  let [end, begin] = [0, 0];
  return {
    add(bytes) {
      for (let done = 0; done < bytes.length;) {
        const written = writeSync(descriptor, bytes, done, bytes.length - done, end);
        done += written;
        end += written;
      }
    },
    *take(count) {
      for (const stop = begin + count; begin < stop;) {
        const piece = new Uint8Array(Math.min(PIECE_BYTES, stop - begin));
        const read = readSync(descriptor, piece, 0, piece.length, begin);
        if (read === 0) throw new Error(`${name} is shorter than what was written to it`);
        begin += read;
        yield piece.subarray(0, read);
      }
    },
    close() {
      closeSync(descriptor);
      if (!isRemoved) remove(name);
    },
  };
}

/** Returns whether the file is removed; a system may refuse it while the file is open. */
function remove(file: string): boolean {
  try {
    rmSync(file, { force: true });
    return true;
  } catch {
    return false;
  }
}
