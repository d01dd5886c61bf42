/**
 * Corners of the faces of a tetrahedron abcd with (b-a)×(c-a)·(d-a) > 0, three local node indices per face. Face f
 * lies opposite node f and is counter-clockwise seen from outside.
 */
export const faceNodes = [1, 2, 3, 0, 3, 2, 0, 1, 3, 0, 2, 1] as const;

/** Neighbour index of a face without a neighbour. */
export const outside = -1;

/** Hash of a node triple. The factors are odd and have about 32 random bits. */
function hash(a: number, b: number, c: number): number {
  return (Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca77) ^ Math.imul(c, 0xc2b2ae3d)) >>> 0;
}

/**
 * Returns, for each face 4t + f of tetrahedron t, the tetrahedron beyond it, or `outside`. Takes linear time: a hash
 * table with open addressing holds the faces whose neighbour has not been found yet.
 */
export function findNeighbours(tetrahedra: Uint32Array): Int32Array {
  const faceCount = tetrahedra.length;
  const neighbours = new Int32Array(faceCount).fill(outside);
  let capacity = 16;
  while (capacity < 2 * faceCount) capacity *= 2;
  const mask = capacity - 1;
  const table = new Int32Array(capacity).fill(-1);
  const keys = new Uint32Array(3 * faceCount);
  for (let face = 0; face < faceCount; ++face) {
    const base = face & ~3;
    const local = 3 * (face & 3);
    const p = tetrahedra[base + (faceNodes[local] ?? 0)] ?? 0;
    const q = tetrahedra[base + (faceNodes[local + 1] ?? 0)] ?? 0;
    const r = tetrahedra[base + (faceNodes[local + 2] ?? 0)] ?? 0;
    const low = Math.min(p, q, r);
    const high = Math.max(p, q, r);
    const middle = p + q + r - low - high;
    keys[3 * face] = low;
    keys[3 * face + 1] = middle;
    keys[3 * face + 2] = high;
    let slot = hash(low, middle, high) & mask;
    for (;;) {
      const other = table[slot] ?? -1;
      if (other < 0) {
        table[slot] = face;
        break;
      }
      if (keys[3 * other] === low && keys[3 * other + 1] === middle && keys[3 * other + 2] === high) {
        neighbours[face] = other >> 2;
        neighbours[other] = face >> 2;
        break;
      }
      slot = (slot + 1) & mask;
    }
  }
  return neighbours;
}

/** The six edges of a tetrahedron, two local node indices each. */
const edgeNodes = [0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3] as const;

/** Returns each edge of the tetrahedra once, as two nodes, in order of appearance. Takes linear time. */
export function uniqueEdges(tetrahedra: Uint32Array): Uint32Array {
  const maxEdges = (tetrahedra.length / 4) * 6;
  const edges = new Uint32Array(2 * maxEdges);
  let capacity = 16;
  while (capacity < 2 * maxEdges) capacity *= 2;
  const mask = capacity - 1;
  const table = new Int32Array(capacity).fill(-1);
  let count = 0;
  for (let base = 0; base < tetrahedra.length; base += 4) {
    for (let k = 0; k < edgeNodes.length; k += 2) {
      const p = tetrahedra[base + (edgeNodes[k] ?? 0)] ?? 0;
      const q = tetrahedra[base + (edgeNodes[k + 1] ?? 0)] ?? 0;
      const low = Math.min(p, q);
      const high = Math.max(p, q);
      let slot = hash(low, high, 0) & mask;
      for (;;) {
        const other = table[slot] ?? -1;
        if (other < 0) {
          table[slot] = count;
          edges[2 * count] = low;
          edges[2 * count + 1] = high;
          ++count;
          break;
        }
        if (edges[2 * other] === low && edges[2 * other + 1] === high) break;
        slot = (slot + 1) & mask;
      }
    }
  }
  return edges.subarray(0, 2 * count);
}
