/**
 * Keeps the bytes of a file that must be preceded by what is known only after they were made, such as their number: in
 * memory, or where the caller has more room.
 */
export interface Spool {
  /** Adds bytes at the end; they may change afterwards. */
  readonly add: (bytes: Uint8Array) => void;
  /** Yields so many bytes in order, from where the last call has ended. */
  readonly take: (count: number) => Iterable<Uint8Array>;
  /** Releases the bytes. */
  readonly close: () => void;
}

/** Returns a spool in memory. */
export function memorySpool(): Spool {
  const pieces: Uint8Array[] = [];
  return {
    add: (bytes) => void pieces.push(bytes),
    *take(count) {
      for (let left = count; left > 0;) {
        const [piece = NOTHING] = pieces.splice(0, 1);
        if (piece.length > left) pieces.unshift(piece.subarray(left));
        const taken = piece.subarray(0, left);
        if (taken.length === 0) return;
        left -= taken.length;
        yield taken;
      }
    },
    close: () => void pieces.splice(0),
  };
}

const NOTHING = new Uint8Array();
