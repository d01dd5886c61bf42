/** The triangles of the faces of a BREP file, if the kernel has made some. */
import type { BrepWords } from "./brep-words.js";
import type { Placing } from "./brep-locations.js";
import type { ModelTriangles } from "./trimmed-model.js";

/** The triangles of one face, in the coordinates of its shape. */
export interface Triangulation {
  /** x y z per node. */
  readonly points: Float64Array;
  /** u v per node; empty if the file has none. */
  readonly parameters: Float64Array;
  /** Three nodes each, counter-clockwise about the normal of the surface. */
  readonly triangles: Uint32Array;
}

/** Reads a triangulation; `hasNormals`: whether it says if it has normals. */
export function readTriangulation(words: BrepWords, hasNormals: boolean): Triangulation {
  const [nodes, triangles] = [words.count(), words.count()];
  const hasParameters = words.flag();
  const areNormals = hasNormals && words.flag();
  words.number();
  const points = words.numbers(3 * nodes);
  const parameters = words.numbers(hasParameters ? 2 * nodes : 0);
  const corners = Uint32Array.from(words.numbers(3 * triangles), (number) => {
    if (!(number >= 1 && number <= nodes))
      throw words.wrong("a triangle refers to a node that does not exist");
    return number - 1;
  });
  if (areNormals) words.numbers(3 * nodes);
  return { points, parameters, triangles: corners };
}

/** A face of a file where it is in the whole. */
export interface TriangulatedFace {
  /** Its index in the model; undefined if it cannot be described. */
  readonly face: number | undefined;
  /** Undefined if the file has none. */
  readonly triangulation: Triangulation | undefined;
  readonly placing: Placing;
  readonly isReversed: boolean;
}

/** Triangles of faces, each with nodes of its own, counter-clockwise seen from outside. */
export interface FaceTriangles {
  /** x y z per node. */
  readonly points: Float64Array;
  /** u v per node; zeros where a face has none. */
  readonly parameters: Float64Array;
  readonly triangles: Uint32Array;
  /** Per face: number of its triangles, which follow those of the face before it. */
  readonly counts: readonly number[];
}

/** Returns the triangles of faces. O(n). */
export function trianglesOf(faces: readonly TriangulatedFace[]): FaceTriangles {
  const sum = (field: "points" | "triangles") =>
    faces.reduce((all, { triangulation }) => all + (triangulation?.[field].length ?? 0), 0);
  const points = new Float64Array(sum("points"));
  const parameters = new Float64Array((points.length / 3) * 2);
  const triangles = new Uint32Array(sum("triangles"));
  let [node, corner] = [0, 0];
  const counts = faces.map(({ triangulation, placing, isReversed }) => {
    if (triangulation === undefined) return 0;
    points.set(placing.points(triangulation.points), 3 * node);
    parameters.set(triangulation.parameters, 2 * node);
    const own = triangulation.triangles;
    for (let c = 0; c < own.length; c += 3) {
      const [a = 0, b = 0, d = 0] = own.subarray(c, c + 3);
      triangles.set(isReversed ? [node + a, node + d, node + b] : [node + a, node + b, node + d], corner);
      corner += 3;
    }
    node += triangulation.points.length / 3;
    return own.length / 3;
  });
  return { points, parameters, triangles, counts };
}

/** Returns the triangles of the faces that are described, and have parameters. O(n). */
export function modelTrianglesOf(
  faces: readonly TriangulatedFace[],
  { points, parameters, triangles, counts }: FaceTriangles,
): ModelTriangles {
  const near: number[] = [];
  const faceOf: number[] = [];
  let first = 0;
  faces.forEach(({ face, triangulation }, f) => {
    const end = first + (counts[f] ?? 0);
    if (face !== undefined && triangulation !== undefined && triangulation.parameters.length > 0)
      for (let t = first; t < end; t++) {
        near.push(triangles[3 * t] ?? 0, triangles[3 * t + 1] ?? 0, triangles[3 * t + 2] ?? 0);
        faceOf.push(face);
      }
    first = end;
  });
  return { points, parameters, triangles: Uint32Array.from(near), faces: Uint32Array.from(faceOf) };
}
