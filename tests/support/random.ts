/** Returns a generator of integers below 2^32, the same on every machine (Marsaglia's xorshift). */
export function randomSource(seed: number): () => number {
  let state = seed;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return state >>> 0;
  };
}

/** Changes some bytes, inserts an absurd number, removes, moves or repeats a piece, or truncates the file. */
export function mutated(file: Uint8Array, random: () => number): Uint8Array {
  const at = random() % file.length;
  const length = random() % 40;
  switch (random() % 6) {
    case 0:
      return file.map((byte) => (random() % 50 === 0 ? random() & 255 : byte));
    case 1:
      return joined(file.subarray(0, at), file.subarray(at + length));
    case 2:
      return joined(file.subarray(0, at + length), file.subarray(at));
    case 3:
      return file.slice(0, at);
    case 4: {
      const text = ABSURD[random() % ABSURD.length] ?? "";
      return joined(file.subarray(0, at), new TextEncoder().encode(text), file.subarray(at + text.length));
    }
    default: {
      const other = random() % file.length;
      // The slice of a Buffer shares its bytes, so that the next file would be damaged more.
      const copy = Uint8Array.from(file);
      copy.set(file.subarray(at, at + length).subarray(0, file.length - other), other);
      return copy;
    }
  }
}

const ABSURD = [
  "-1",
  "4294967295",
  "1e308",
  "9007199254740993",
  "nan",
  "\xff\xff\xff\xff",
  "0",
  "0 0 0 0",
  "\n\n\n",
];

function joined(...parts: readonly Uint8Array[]): Uint8Array {
  const bytes = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}
