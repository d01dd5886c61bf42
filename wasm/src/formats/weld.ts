/** Exact welding: points with the same three coordinates become one. No tolerance; -0 equals 0. */

export interface WeldedPoints {
  /** x y z of the different points, in order of first appearance. */
  readonly points: Float64Array;
  /** Per given point: its position in `points`. */
  readonly positions: Uint32Array;
}

const EMPTY = 0xffffffff;

/** Welds x y z triples. O(n) expected: open addressing over the bits of the coordinates. */
export function weldPoints(given: Float64Array): WeldedPoints {
  const count = given.length / 3;
  // Adding 0 turns -0 into 0 and leaves every other value alone.
  const values = given.map((value) => value + 0);
  const bits = new Uint32Array(values.buffer, values.byteOffset, 2 * values.length);
  const mask = tableSize(count) - 1;
  const table = new Uint32Array(mask + 1).fill(EMPTY);
  const firstOf = new Uint32Array(count);
  const positions = new Uint32Array(count);
  let found = 0;
  for (let i = 0; i < count; i++) {
    let slot = hash(bits, 6 * i) & mask;
    for (;;) {
      const known = table[slot] ?? EMPTY;
      if (known === EMPTY) {
        table[slot] = found;
        firstOf[found] = i;
        positions[i] = found++;
        break;
      }
      if (areEqual(bits, 6 * i, 6 * (firstOf[known] ?? 0))) {
        positions[i] = known;
        break;
      }
      slot = (slot + 1) & mask;
    }
  }
  const points = new Float64Array(3 * found);
  for (let p = 0; p < found; p++) {
    const first = 3 * (firstOf[p] ?? 0);
    points.set(values.subarray(first, first + 3), 3 * p);
  }
  return { points, positions };
}

/** A power of two that keeps the table at most half full. */
function tableSize(count: number): number {
  let size = 16;
  while (size < 2 * count) size *= 2;
  return size;
}

function hash(bits: Uint32Array, begin: number): number {
  let h = 0x811c9dc5;
  for (let i = begin; i < begin + 6; i++) {
    h = Math.imul(h ^ (bits[i] ?? 0), 0x9e3779b1);
    h ^= h >>> 15;
  }
  return h >>> 0;
}

function areEqual(bits: Uint32Array, a: number, b: number): boolean {
  for (let i = 0; i < 6; i++) {
    if (bits[a + i] !== bits[b + i]) return false;
  }
  return true;
}
