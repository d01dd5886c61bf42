/** Which tetrahedra stand on either side of a triangle. */
import type { FileMesh } from "./file-mesh.js";

export const NONE = 0xffffffff;

/** The corners of face f of a positive tetrahedron, counter-clockwise seen from outside; opposite corner f. */
const FACES = [
  [1, 2, 3],
  [0, 3, 2],
  [0, 1, 3],
  [0, 2, 1],
] as const;

export interface TetFaces {
  /** Per face 4 t + f of all tetrahedra: the same face of the other tetrahedron, or NONE. */
  readonly twin: Uint32Array;
  /** Per face: the triangle of the mesh on it, or NONE. */
  readonly triangle: Uint32Array;
  /** Per triangle: the face on which it lies, of two the one that it looks out of, or NONE. */
  readonly faceOfTriangle: Uint32Array;
}

/** O(n): faces are sorted into buckets by their lowest node, which few share. */
export function tetFaces({ points, triangles, tetrahedra }: FileMesh): TetFaces {
  const faceCount = tetrahedra.length;
  const heads = new Uint32Array(points.length / 3).fill(NONE);
  const next = new Uint32Array(faceCount);
  const twin = new Uint32Array(faceCount).fill(NONE);
  for (let face = 0; face < faceCount; face++) {
    const [low, middle, high] = sorted(cornersOf(tetrahedra, face));
    let known = heads[low] ?? NONE;
    while (known !== NONE && !isFace(known, middle, high)) known = next[known] ?? NONE;
    if (known !== NONE && twin[known] === NONE) {
      twin[known] = face;
      twin[face] = known;
    } else {
      next[face] = heads[low] ?? NONE;
      heads[low] = face;
    }
  }
  const triangle = new Uint32Array(faceCount).fill(NONE);
  const faceOfTriangle = new Uint32Array(triangles.length / 3).fill(NONE);
  faceOfTriangle.forEach((_, t) => {
    const corners = [triangles[3 * t] ?? 0, triangles[3 * t + 1] ?? 0, triangles[3 * t + 2] ?? 0] as const;
    const [low, middle, high] = sorted(corners);
    let found = heads[low] ?? NONE;
    while (found !== NONE && !isFace(found, middle, high)) found = next[found] ?? NONE;
    if (found === NONE) return;
    const other = twin[found] ?? NONE;
    triangle[found] = t;
    if (other !== NONE) triangle[other] = t;
    faceOfTriangle[t] = other === NONE || isTurnedAs(cornersOf(tetrahedra, found), corners) ? found : other;
  });
  return { twin, triangle, faceOfTriangle };

  /** Of two faces with the same lowest node: whether the others are the same too. */
  function isFace(face: number, middle: number, high: number): boolean {
    const [, m, h] = sorted(cornersOf(tetrahedra, face));
    return m === middle && h === high;
  }
}

type Triple = readonly [number, number, number];

/** The nodes of face 4 t + f, counter-clockwise seen from outside the tetrahedron. */
export function cornersOf(tetrahedra: Uint32Array, face: number): Triple {
  const begin = face & ~3;
  const [a, b, c] = FACES[face & 3] ?? FACES[0];
  return [tetrahedra[begin + a] ?? 0, tetrahedra[begin + b] ?? 0, tetrahedra[begin + c] ?? 0];
}

function sorted([a, b, c]: Triple): Triple {
  const low = Math.min(a, b, c);
  const high = Math.max(a, b, c);
  return [low, a + b + c - low - high, high];
}

/** Whether two triples of the same nodes run the same way round. */
function isTurnedAs([a, b, c]: Triple, [x, y, z]: Triple): boolean {
  return (
    (a === x && b === y && c === z) || (a === y && b === z && c === x) || (a === z && b === x && c === y)
  );
}
