/** Which tetrahedra stand on either side of a triangle. */
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { Diagnostic } from "../api/types.js";
import type { FileMesh } from "./file-mesh.js";
import { sixfoldVolume } from "./sixfold-volume.js";
import { BREATH, stepwise, type Steps } from "./steps.js";

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
  /** Faces of a third tetrahedron where there are two already. */
  readonly crowded: readonly number[];
}

/** O(n) expected: faces are sorted into buckets by all their nodes, as many may share one or two. */
export function* tetFaces({ triangles, tetrahedra }: FileMesh): Steps<TetFaces> {
  const faceCount = tetrahedra.length;
  let buckets = 16;
  while (buckets < faceCount) buckets *= 2;
  const heads = new Uint32Array(buckets).fill(NONE);
  yield BREATH;
  const next = new Uint32Array(faceCount);
  const twin = new Uint32Array(faceCount).fill(NONE);
  yield BREATH;
  const crowded: number[] = [];
  yield* stepwise(faceCount, (face) => {
    const corners = sorted(cornersOf(tetrahedra, face));
    const bucket = bucketOf(corners);
    const known = firstIn(bucket, corners);
    if (known !== NONE && twin[known] === NONE) {
      twin[known] = face;
      twin[face] = known;
    } else {
      if (known !== NONE) crowded.push(face);
      next[face] = heads[bucket] ?? NONE;
      heads[bucket] = face;
    }
  });
  const triangle = new Uint32Array(faceCount).fill(NONE);
  const faceOfTriangle = new Uint32Array(triangles.length / 3).fill(NONE);
  yield* stepwise(faceOfTriangle.length, (t) => {
    const corners = [triangles[3 * t] ?? 0, triangles[3 * t + 1] ?? 0, triangles[3 * t + 2] ?? 0] as const;
    const wanted = sorted(corners);
    const found = firstIn(bucketOf(wanted), wanted);
    if (found === NONE) return;
    const other = twin[found] ?? NONE;
    triangle[found] = t;
    if (other !== NONE) triangle[other] = t;
    faceOfTriangle[t] = other === NONE || isTurnedAs(cornersOf(tetrahedra, found), corners) ? found : other;
  });
  return { twin, triangle, faceOfTriangle, crowded };

  function bucketOf([low, middle, high]: Triple): number {
    let h = 0;
    for (const node of [low, middle, high]) {
      h = Math.imul(h ^ node, 0x9e3779b1);
      h ^= h >>> 15;
    }
    return h & (buckets - 1);
  }

  /** The latest face of a bucket that has these corners, in ascending order. */
  function firstIn(bucket: number, [low, middle, high]: Triple): number {
    let face = heads[bucket] ?? NONE;
    for (; face !== NONE; face = next[face] ?? NONE) {
      const [l, m, h] = sorted(cornersOf(tetrahedra, face));
      if (l === low && m === middle && h === high) break;
    }
    return face;
  }
}

type Triple = readonly [number, number, number];

/** The nodes of face 4 t + f, counter-clockwise seen from outside the tetrahedron. */
export function cornersOf(tetrahedra: Uint32Array, face: number): Triple {
  const begin = face & ~3;
  const [a, b, c] = FACES[face & 3] ?? FACES[0];
  return [tetrahedra[begin + a] ?? 0, tetrahedra[begin + b] ?? 0, tetrahedra[begin + c] ?? 0];
}

/** The same three nodes the other way round. */
function isMirrored(tetrahedra: Uint32Array, face: number, other: number): boolean {
  return !isTurnedAs(cornersOf(tetrahedra, face), cornersOf(tetrahedra, other));
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

/** The tetrahedra that keep a mesh from fitting together, by what is wrong with them. */
export function* misfits(mesh: FileMesh, { twin, crowded }: TetFaces): Steps<Diagnostic[]> {
  const { points, tetrahedra } = mesh;
  const inverted: number[] = [];
  const flat: number[] = [];
  yield* stepwise(tetrahedra.length / 4, (t) => {
    const [a = 0, b = 0, c = 0, d = 0] = tetrahedra.subarray(4 * t, 4 * t + 4);
    const { volume, isSure } = sixfoldVolume(points, a, b, c, d);
    // Where doubles do not tell, an element is accused of nothing.
    if (!isSure) return;
    if (volume < 0) inverted.push(t);
    if (volume === 0) flat.push(t);
  });
  const overlapping = new Set<number>();
  yield* stepwise(twin.length, (face) => {
    const other = twin[face] ?? NONE;
    if (other !== NONE && !isMirrored(tetrahedra, face, other)) overlapping.add(face >>> 2);
  });
  const third = new Set(crowded.map((face) => face >>> 2));
  return [
    ...fault(inverted, "inside out", "Exchange two nodes of each."),
    ...fault(flat, "without volume", "Mesh the body again."),
    ...fault([...overlapping], "on the same side of a face as another, or repeat it", "Remove one of each."),
    ...fault([...third], "on a face that two others share", "Mesh the body again."),
  ];
}

/** So many ids are named; the number of all is told, too. */
const MOST_IDS = 10;

function fault(ids: readonly number[], words: string, remedy: string): Diagnostic[] {
  if (ids.length === 0) return [];
  const named = ids.slice(0, MOST_IDS).join(", ");
  const more = ids.length > MOST_IDS ? ` and ${ids.length - MOST_IDS} more` : "";
  const message = `${ids.length === 1 ? "tetrahedron" : `${ids.length} tetrahedra:`} ${named}${more} (counted from 0): ${words}`;
  return [packageDiagnostic("unsound-mesh", message, remedy)];
}

/** As `tetFaces`, for formats whose faces must fit together. Throws a MesherError where they do not. */
export function* soundFaces(mesh: FileMesh): Steps<TetFaces> {
  const faces = yield* tetFaces(mesh);
  refuse(yield* misfits(mesh, faces));
  return faces;
}
