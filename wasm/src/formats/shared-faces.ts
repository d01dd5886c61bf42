/** Finds faces that two shapes share, so that the surface has them once: interfaces between the shapes. */
import { PAUSE, STEP, type Steps, stepwise } from "../base/steps.js";
import {
  centroidOf,
  type Corners,
  cornersOf,
  dot,
  lengthOf,
  normalOf,
  plus,
  scaled,
  type Vector,
} from "../base/vectors.js";
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
      areNear(joined, [other, face].map(trianglesIn), tolerance);
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
function areNear(joined: JoinedShapes, faces: readonly Iterable<number>[], tolerance: number): boolean {
  let [volume, area] = [0, 0];
  for (const face of faces) {
    for (const t of face) {
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
 * `shareFaces` does: a file of triangles has no faces, or one for a whole shape. O(n log n) for n triangles.
 */
export function* sharePlanarPieces(joined: JoinedShapes): Steps<void> {
  const { shapeOf, twin, isDropped } = joined;
  const tolerance = SAME * diagonalOf(joined.points);
  const isCommon = commonNodes(joined);
  const known = new Map<string, readonly number[]>();
  for (const piece of yield* planarPieces(joined, isCommon)) {
    const own = boundaryKeys(joined, piece, isCommon);
    if (own.forward === "") continue;
    const [first = 0] = piece;
    const other = known.get(own.backward) ?? [];
    const [otherFirst = first] = other;
    if (shapeOf[otherFirst] !== shapeOf[first] && areNear(joined, [other, piece], tolerance)) {
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

/**
 * Largest distance of a node from the plane of its piece, relative to the diagonal: above the welding and the rounding of
 * files with six digits, far below any detail.
 */
const PLANAR = 2e-6;

/**
 * Returns the triangles that no other shape has yet, in connected planar pieces of faces. Each piece has a common node, and
 * grows from its largest triangle with one.
 */
function* planarPieces(joined: JoinedShapes, isCommon: Uint8Array): Steps<number[][]> {
  const { triangles, shapeOf, twin, isDropped } = joined;
  const seeds: number[] = [];
  const isFree = new Uint8Array(shapeOf.length);
  yield* stepwise(shapeOf.length, (t) => {
    if (isDropped[t] === 1 || twin[t] !== t) return;
    isFree[t] = 1;
    if (triangles.subarray(3 * t, 3 * t + 3).some((node) => isCommon[node] === 1)) seeds.push(t);
  });
  if (seeds.length === 0) return [];
  const areas = new Map(seeds.map((t) => [t, doubledAreaOf(joined, t)]));
  seeds.sort((a, b) => (areas.get(b) ?? 0) - (areas.get(a) ?? 0) || a - b);
  const neighbors = yield* trianglesAtNodes(joined, isFree);
  const tolerance = PLANAR * diagonalOf(joined.points);
  const pieces: number[][] = [];
  for (const seed of seeds) {
    if (isFree[seed] === 0) continue;
    const piece = yield* planarPiece(joined, seed, isFree, neighbors, tolerance);
    pieces.push(piece.sort((a, b) => a - b));
  }
  return pieces.sort(([a = 0], [b = 0]) => a - b);
}

/** Triangles per node: those of node n are `all` from `firsts[n]` to `firsts[n + 1]`, exclusive. */
interface TrianglesAtNodes {
  readonly firsts: Uint32Array;
  readonly all: Uint32Array;
}

function* trianglesAtNodes({ points, triangles }: JoinedShapes, isFree: Uint8Array): Steps<TrianglesAtNodes> {
  const nodes = points.length / 3;
  const firsts = new Uint32Array(nodes + 1);
  yield* stepwise(triangles.length, (corner) => {
    const after = (triangles[corner] ?? 0) + 1;
    if (isFree[Math.floor(corner / 3)] === 1) firsts[after] = (firsts[after] ?? 0) + 1;
  });
  for (let n = 0; n < nodes; n++) firsts[n + 1] = (firsts[n + 1] ?? 0) + (firsts[n] ?? 0);
  const next = firsts.slice();
  const all = new Uint32Array(firsts[nodes] ?? 0);
  yield* stepwise(triangles.length, (corner) => {
    const t = Math.floor(corner / 3);
    if (isFree[t] === 0) return;
    const node = triangles[corner] ?? 0;
    const at = next[node] ?? 0;
    all[at] = t;
    next[node] = at + 1;
  });
  return { firsts, all };
}

/** Returns the planar piece of a face around a triangle; its triangles are no longer free. */
function* planarPiece(
  joined: JoinedShapes,
  seed: number,
  isFree: Uint8Array,
  { firsts, all }: TrianglesAtNodes,
  tolerance: number,
): Steps<number[]> {
  const { triangles, faceOf, shapeOf } = joined;
  const plane = new MeanPlane(cornersOf(joined, seed));
  const valence = (node: number) => (firsts[node + 1] ?? 0) - (firsts[node] ?? 0);
  const piece = [seed];
  isFree[seed] = 0;
  for (let i = 0; i < piece.length; i++) {
    const t = piece[i] ?? 0;
    for (let k = 0; k < 3; k++) {
      const [a = 0, b = 0] = [triangles[3 * t + k], triangles[3 * t + ((k + 1) % 3)]];
      // A fan has many triangles at one end of its edges.
      const node = valence(a) < valence(b) ? a : b;
      for (let at = firsts[node] ?? 0; at < (firsts[node + 1] ?? 0); at++) {
        const other = all[at] ?? 0;
        if (isFree[other] === 0 || faceOf[other] !== faceOf[t] || shapeOf[other] !== shapeOf[t]) continue;
        if (!hasEdge(triangles, other, b, a)) continue;
        const corners = cornersOf(joined, other);
        if (!plane.isNear(corners, tolerance)) continue;
        plane.add(corners);
        isFree[other] = 0;
        piece.push(other);
      }
    }
    if (i % STEP === 0) yield PAUSE;
  }
  return piece;
}

/** Returns whether a triangle has an edge in this direction. */
function hasEdge(triangles: Uint32Array, t: number, from: number, to: number): boolean {
  const [a, b, c] = [triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]];
  return (a === from && b === to) || (b === from && c === to) || (c === from && a === to);
}

/** Plane of triangles: the sum of their normals depends on their boundary only, so that small triangles do not tilt it. */
class MeanPlane {
  #normal: Vector = [0, 0, 0];
  /** Sum of the centroids, each times the length of its normal. */
  #moment: Vector = [0, 0, 0];
  #weight = 0;

  constructor(first: Corners) {
    this.add(first);
  }

  add(corners: Corners): void {
    const normal = normalOf(corners);
    const weight = lengthOf(normal);
    this.#normal = plus(this.#normal, normal);
    this.#moment = plus(this.#moment, scaled(centroidOf(corners), weight));
    this.#weight += weight;
  }

  /** Returns whether the corners are in the plane, and the triangle is not folded over. */
  isNear(corners: Corners, tolerance: number): boolean {
    const length = lengthOf(this.#normal);
    if (!(length > 0) || dot(normalOf(corners), this.#normal) < 0) return false;
    const height = dot(this.#moment, this.#normal) / this.#weight;
    return corners.every((corner) => Math.abs(dot(corner, this.#normal) - height) <= tolerance * length);
  }
}
