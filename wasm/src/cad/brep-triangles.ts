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

/** A face of a model where it is in the whole, with its triangles. */
export interface TriangulatedFace {
  readonly face: number;
  readonly triangulation: Triangulation;
  readonly placing: Placing;
  readonly isReversed: boolean;
}

/** Returns the triangles of all faces, counter-clockwise seen from outside; faces without parameters have none. O(n). */
export function modelTrianglesOf(faces: readonly TriangulatedFace[]): ModelTriangles {
  const used = faces.filter(({ triangulation }) => triangulation.parameters.length > 0);
  const sum = (sizeOf: (triangulation: Triangulation) => number) =>
    used.reduce((all, { triangulation }) => all + sizeOf(triangulation), 0);
  const points = new Float64Array(sum((one) => one.points.length));
  const parameters = new Float64Array(sum((one) => one.parameters.length));
  const triangles = new Uint32Array(sum((one) => one.triangles.length));
  const faceOf = new Uint32Array(triangles.length / 3);
  let [node, corner] = [0, 0];
  for (const { face, triangulation, placing, isReversed } of used) {
    const first = node;
    points.set(placing.points(triangulation.points), 3 * first);
    parameters.set(triangulation.parameters, 2 * first);
    triangles.set(
      triangulation.triangles.map((own) => own + first),
      corner,
    );
    const end = corner + triangulation.triangles.length;
    for (let c = corner; isReversed && c < end; c += 3)
      [triangles[c + 1], triangles[c + 2]] = [triangles[c + 2] ?? 0, triangles[c + 1] ?? 0];
    faceOf.fill(face, corner / 3, end / 3);
    node += triangulation.points.length / 3;
    corner = end;
  }
  return { points, parameters, triangles, faces: faceOf };
}
