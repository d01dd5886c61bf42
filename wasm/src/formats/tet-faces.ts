/** Adjacency of tetrahedra and triangles, and the checks that depend on it. */
import { PAUSE, type Steps, stepwise } from "../base/steps.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { Mesh } from "../mesh/mesh.js";
import { sixfoldVolume } from "./sixfold-volume.js";

export const NONE = 0xffffffff;

/** Corners of face f of a positive tetrahedron, counter-clockwise seen from outside; face f is opposite corner f. */
const FACES = [
  [1, 2, 3],
  [0, 3, 2],
  [0, 1, 3],
  [0, 2, 1],
] as const;

export interface TetFaces {
  /** Per face 4 t + f of all tetrahedra: the same face of the other tetrahedron, or NONE. */
  readonly twin: Uint32Array;
  /** Per face: the triangle with the same nodes, or NONE. */
  readonly triangle: Uint32Array;
  /**
   * Per triangle: the face with the same nodes, or NONE. If there are two faces, it is the one with the triangle's
   * orientation.
   */
  readonly faceOfTriangle: Uint32Array;
  /** Faces whose nodes two other faces already share. */
  readonly nonManifold: readonly number[];
}

/**
 * Finds the faces that share nodes. O(n) expected: buckets are hashed by all three nodes, as many faces may share
 * one or two.
 */
export function* tetFaces({ triangles, tetrahedra }: Mesh): Steps<TetFaces> {
  const faceCount = tetrahedra.length;
  let buckets = 16;
  while (buckets < faceCount) buckets *= 2;
  const heads = new Uint32Array(buckets).fill(NONE);
  yield PAUSE;
  const next = new Uint32Array(faceCount);
  const twin = new Uint32Array(faceCount).fill(NONE);
  yield PAUSE;
  const nonManifold: number[] = [];
  yield* stepwise(faceCount, (face) => {
    const corners = sorted(cornersOf(tetrahedra, face));
    const bucket = bucketOf(corners);
    const known = firstIn(bucket, corners);
    if (known !== NONE && twin[known] === NONE) {
      twin[known] = face;
      twin[face] = known;
    } else {
      if (known !== NONE) nonManifold.push(face);
      next[face] = heads[bucket] ?? NONE;
      heads[bucket] = face;
    }
  });
  const triangle = new Uint32Array(faceCount).fill(NONE);
  const faceOfTriangle = new Uint32Array(triangles.length / 3).fill(NONE);
  yield* stepwise(faceOfTriangle.length, (t) => {
    const corners = [triangles[3 * t] ?? 0, triangles[3 * t + 1] ?? 0, triangles[3 * t + 2] ?? 0] as const;
    const nodes = sorted(corners);
    const found = firstIn(bucketOf(nodes), nodes);
    if (found === NONE) return;
    const other = twin[found] ?? NONE;
    triangle[found] = t;
    if (other !== NONE) triangle[other] = t;
    faceOfTriangle[t] =
      other === NONE || hasSameOrientation(cornersOf(tetrahedra, found), corners) ? found : other;
  });
  return { twin, triangle, faceOfTriangle, nonManifold };

  function bucketOf([low, middle, high]: FaceNodes): number {
    let h = 0;
    for (const node of [low, middle, high]) {
      h = Math.imul(h ^ node, 0x9e3779b1);
      h ^= h >>> 15;
    }
    return h & (buckets - 1);
  }

  /** Returns the latest face of a bucket with these corners, which are in ascending order. */
  function firstIn(bucket: number, [low, middle, high]: FaceNodes): number {
    let face = heads[bucket] ?? NONE;
    for (; face !== NONE; face = next[face] ?? NONE) {
      const [l, m, h] = sorted(cornersOf(tetrahedra, face));
      if (l === low && m === middle && h === high) break;
    }
    return face;
  }
}

type FaceNodes = readonly [number, number, number];

/** Returns the nodes of face 4 t + f, counter-clockwise seen from outside the tetrahedron. */
export function cornersOf(tetrahedra: Uint32Array, face: number): FaceNodes {
  const begin = face & ~3;
  const [a, b, c] = FACES[face & 3] ?? FACES[0];
  return [tetrahedra[begin + a] ?? 0, tetrahedra[begin + b] ?? 0, tetrahedra[begin + c] ?? 0];
}

/** Returns whether two faces with the same nodes have opposite orientations. */
function hasOppositeOrientation(tetrahedra: Uint32Array, face: number, other: number): boolean {
  return !hasSameOrientation(cornersOf(tetrahedra, face), cornersOf(tetrahedra, other));
}

function sorted([a, b, c]: FaceNodes): FaceNodes {
  const low = Math.min(a, b, c);
  const high = Math.max(a, b, c);
  return [low, a + b + c - low - high, high];
}

/** Returns whether two triples of the same nodes have the same orientation. */
function hasSameOrientation([a, b, c]: FaceNodes, [x, y, z]: FaceNodes): boolean {
  return (
    (a === x && b === y && c === z) || (a === y && b === z && c === x) || (a === z && b === x && c === y)
  );
}

/** Reports the tetrahedra that do not fit into a valid mesh, by kind of defect. */
export function* findDefects(mesh: Mesh, { twin, nonManifold }: TetFaces): Steps<Diagnostic[]> {
  const { points, tetrahedra } = mesh;
  const inverted: number[] = [];
  const flat: number[] = [];
  yield* stepwise(tetrahedra.length / 4, (t) => {
    const [a = 0, b = 0, c = 0, d = 0] = tetrahedra.subarray(4 * t, 4 * t + 4);
    const { volume, isSure } = sixfoldVolume(points, a, b, c, d);
    // Report only defects that double precision proves.
    if (!isSure) return;
    if (volume < 0) inverted.push(t);
    if (volume === 0) flat.push(t);
  });
  const overlapping = new Set<number>();
  yield* stepwise(twin.length, (face) => {
    const other = twin[face] ?? NONE;
    if (other !== NONE && !hasOppositeOrientation(tetrahedra, face, other)) overlapping.add(face >>> 2);
  });
  const third = new Set(nonManifold.map((face) => face >>> 2));
  return [
    ...fault(inverted, "inverted", "Swap two nodes of each."),
    ...fault(flat, "degenerate (without volume)", "Mesh the region again."),
    ...fault(
      [...overlapping],
      "on the same side of a face as another tetrahedron, or a duplicate",
      "Remove one of each pair.",
    ),
    ...fault([...third], "on a face that two others already share", "Mesh the region again."),
  ];
}

/** Largest number of ids in a message, which also states their total number. */
const MAX_IDS = 10;

function fault(ids: readonly number[], words: string, remedy: string): Diagnostic[] {
  if (ids.length === 0) return [];
  const named = ids.slice(0, MAX_IDS).join(", ");
  const more = ids.length > MAX_IDS ? ` and ${ids.length - MAX_IDS} more` : "";
  const message = `${ids.length === 1 ? "tetrahedron" : `${ids.length} tetrahedra:`} ${named}${more} (counted from 0): ${words}`;
  return [packageDiagnostic("invalid-mesh", message, remedy)];
}

/** Returns `tetFaces`, for formats that require a valid mesh. Throws a MesherError if the mesh is invalid. */
export function* validFaces(mesh: Mesh): Steps<TetFaces> {
  const faces = yield* tetFaces(mesh);
  refuse(yield* findDefects(mesh, faces));
  return faces;
}
