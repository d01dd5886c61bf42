/** Finds faces that two shapes share, so that the surface has them once: interfaces between the shapes. */
import { PAUSE, type Steps, stepwise } from "../base/steps.js";
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
    const own = boundaryKeys(joined, face);
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

function* facesOf({ faceOf }: JoinedShapes): Generator<FaceRange> {
  for (let begin = 0; begin < faceOf.length;) {
    let end = begin;
    while (end < faceOf.length && faceOf[end] === faceOf[begin]) end++;
    yield { begin, end };
    begin = end;
  }
}

/** Returns the boundary edges of a face as text, along its boundary and against it; empty if there are none. */
function boundaryKeys(
  { triangles, isDropped }: JoinedShapes,
  { begin, end }: FaceRange,
): { readonly forward: string; readonly backward: string } {
  const edges = new Map<string, readonly [number, number]>();
  for (let t = begin; t < end; t++) {
    if (isDropped[t] === 1) continue;
    for (let k = 0; k < 3; k++) {
      const [a = 0, b = 0] = [triangles[3 * t + k], triangles[3 * t + ((k + 1) % 3)]];
      if (!edges.delete(`${b} ${a}`)) edges.set(`${a} ${b}`, [a, b]);
    }
  }
  const all = [...edges.values()];
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
