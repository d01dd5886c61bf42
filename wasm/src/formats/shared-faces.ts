/** Finds faces that two shapes share, so that the surface has them once: interfaces between the shapes. */
import { PAUSE, type Steps, stepwise } from "../base/steps.js";
import { cornersOf, cross, dot, lengthOf, normalOf } from "../base/vectors.js";
import { doubledAreaOf, type JoinedShapes, sixfoldVolumeBelow } from "./joined-shapes.js";
import { diagonalOf } from "./near-points.js";
import { PointWelder } from "./weld.js";

/** Triangles of a face. */
interface FaceRange {
  readonly begin: number;
  readonly end: number;
}

/**
 * Largest mean distance of two triangulations of one face, relative to the diagonal: twice the distance of each from
 * the face.
 */
const SAME = 1 / 2500;

/**
 * Finds faces of two shapes with the same boundary, which may be triangulated differently: the second one is dropped,
 * and the triangles of the first one serve both.
 */
export function* shareFaces(joined: JoinedShapes): Steps<void> {
  const { shapeOf, twin, isDropped } = joined;
  const tolerance = SAME * diagonalOf(joined.points);
  const known = new Map<string, FaceRange>();
  for (const face of facesOf(joined)) {
    const own = boundaryKeys(joined, trianglesIn(face));
    if (own.forward === "") continue;
    const other = known.get(own.backward);
    const isShared =
      other !== undefined &&
      shapeOf[other.begin] !== shapeOf[face.begin] &&
      twin[other.begin] === other.begin &&
      areNear(joined, other, face, tolerance);
    if (isShared) {
      twin.fill(face.begin, other.begin, other.end);
      isDropped.fill(1, face.begin, face.end);
    } else known.set(own.forward, face);
    yield PAUSE;
  }
}

function* trianglesIn({ begin, end }: FaceRange): Generator<number> {
  for (let t = begin; t < end; t++) yield t;
}

function* facesOf({ faceOf }: JoinedShapes): Generator<FaceRange> {
  for (let begin = 0; begin < faceOf.length;) {
    let end = begin;
    while (end < faceOf.length && faceOf[end] === faceOf[begin]) end++;
    yield { begin, end };
    begin = end;
  }
}

/**
 * Returns the boundary edges of triangles as text, along their boundary and against it; empty if there are none. If
 * `isCommon` is given, also empty if a node of the boundary is not.
 */
function boundaryKeys(
  { triangles, isDropped }: JoinedShapes,
  piece: Iterable<number>,
  isCommon?: Uint8Array,
): { readonly forward: string; readonly backward: string } {
  const edges = new Map<string, readonly [number, number]>();
  for (const t of piece) {
    if (isDropped[t] === 1) continue;
    for (let k = 0; k < 3; k++) {
      const [a = 0, b = 0] = [triangles[3 * t + k], triangles[3 * t + ((k + 1) % 3)]];
      if (!edges.delete(`${b} ${a}`)) edges.set(`${a} ${b}`, [a, b]);
    }
  }
  const all = [...edges.values()];
  if (isCommon !== undefined && all.some(([a]) => isCommon[a] === 0)) return { forward: "", backward: "" };
  const joined = (keys: readonly string[]) => [...keys].sort().join();
  return {
    forward: joined(all.map(([a, b]) => `${a} ${b}`)),
    backward: joined(all.map(([a, b]) => `${b} ${a}`)),
  };
}

/** Returns whether the volume between two faces with the same boundary is as small as that between triangulations. */
function areNear(joined: JoinedShapes, one: FaceRange, other: FaceRange, tolerance: number): boolean {
  let [volume, area] = [0, 0];
  for (const { begin, end } of [one, other]) {
    for (let t = begin; t < end; t++) {
      volume += sixfoldVolumeBelow(joined, t) / 6;
      area += doubledAreaOf(joined, t) / 4;
    }
  }
  return Math.abs(volume) <= tolerance * area;
}

/** Finds triangles of two shapes with the same corners and opposite orientations; the second one is dropped. */
export function* shareTriangles({ triangles, shapeOf, twin, isDropped }: JoinedShapes): Steps<void> {
  const isEven = (t: number) => {
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * t, 3 * t + 3);
    return [a > b, a > c, b > c].filter(Boolean).length % 2 === 0;
  };
  const triples = new PointWelder();
  const firsts: number[] = [];
  yield* stepwise(shapeOf.length, (t) => {
    if (isDropped[t] === 1) return;
    const [a = 0, b = 0, c = 0] = triangles.slice(3 * t, 3 * t + 3).sort();
    const triple = triples.add(a, b, c);
    const first = firsts[triple];
    if (first === undefined) {
      firsts[triple] = t;
      return;
    }
    const isFree = twin[first] === first && shapeOf[first] !== shapeOf[t];
    if (!isFree || isEven(first) === isEven(t)) return;
    twin[first] = t;
    isDropped[t] = 1;
  });
}

/**
 * Finds planar pieces of two shapes with the same boundary, which may be triangulated differently, and treats them as
 * `shareFaces` does: a file of triangles has no faces, or one for a whole shape. O(triangles).
 */
export function* sharePlanarPieces(joined: JoinedShapes): Steps<void> {
  const { shapeOf, twin, isDropped } = joined;
  const isCommon = commonNodes(joined);
  const known = new Map<string, readonly number[]>();
  for (const piece of yield* planarPieces(joined, isCommon)) {
    const own = boundaryKeys(joined, piece, isCommon);
    if (own.forward === "") continue;
    const [first = 0] = piece;
    const other = known.get(own.backward);
    const [otherFirst = first] = other ?? [];
    if (other !== undefined && shapeOf[otherFirst] !== shapeOf[first]) {
      for (const t of other) twin[t] = first;
      for (const t of piece) isDropped[t] = 1;
      known.delete(own.backward);
    } else known.set(own.forward, piece);
    yield PAUSE;
  }
}

/** Returns per node: 1 if several shapes use it. */
function commonNodes({ points, triangles, shapeOf, isDropped }: JoinedShapes): Uint8Array {
  const user = new Uint32Array(points.length / 3).fill(NO_SHAPE);
  const isCommon = new Uint8Array(user.length);
  triangles.forEach((node, corner) => {
    const t = Math.floor(corner / 3);
    if (isDropped[t] === 1) return;
    const shape = shapeOf[t] ?? NO_SHAPE;
    if (user[node] === NO_SHAPE) user[node] = shape;
    else if (user[node] !== shape) isCommon[node] = 1;
  });
  return isCommon;
}

const NO_SHAPE = 0xffffffff;

/** Largest sine of the angle between two triangles of a planar piece. */
const PLANAR = 1e-9;

/** Returns the triangles that no other shape has yet, in connected planar pieces of faces that use common nodes. */
function* planarPieces(joined: JoinedShapes, isCommon: Uint8Array): Steps<number[][]> {
  const { triangles, shapeOf, faceOf, twin, isDropped } = joined;
  const firstAt = new Map<string, number>();
  const pieceOf = new Map<number, number[]>();
  yield* stepwise(shapeOf.length, (t) => {
    const corners = triangles.subarray(3 * t, 3 * t + 3);
    if (isDropped[t] === 1 || twin[t] !== t || corners.every((node) => isCommon[node] === 0)) return;
    let piece = [t];
    pieceOf.set(t, piece);
    for (let k = 0; k < 3; k++) {
      const [a = 0, b = 0] = [corners[k], corners[(k + 1) % 3]];
      const face = faceOf[t] ?? 0;
      firstAt.set(`${face} ${a} ${b}`, t);
      const other = firstAt.get(`${face} ${b} ${a}`);
      const its = other === undefined ? undefined : pieceOf.get(other);
      if (other === undefined || its === undefined || its === piece || !areCoplanar(joined, t, other))
        continue;
      const [large, small] = its.length < piece.length ? [piece, its] : [its, piece];
      for (const one of small) {
        large.push(one);
        pieceOf.set(one, large);
      }
      piece = large;
    }
  });
  return [...new Set(pieceOf.values())].map((piece) => piece.sort((a, b) => a - b));
}

function areCoplanar(joined: JoinedShapes, one: number, other: number): boolean {
  const [a, b] = [normalOf(cornersOf(joined, one)), normalOf(cornersOf(joined, other))];
  const sine = lengthOf(cross(a, b));
  return dot(a, b) > 0 && sine <= PLANAR * lengthOf(a) * lengthOf(b);
}
