/** All elements of a state of a trace, or those behind a plane: the triangles of what they fill, for the graphics card. */
import type { Trace } from "tetrafront/trace";
import type { Position } from "../document/position";

/** Corners of the faces of a tetrahedron, counter-clockwise seen from outside. */
const faces = [
  [0, 2, 1],
  [0, 1, 3],
  [1, 2, 3],
  [0, 3, 2],
] as const;

/** Elements in front of a vertical plane through the middle of the model, towards where the camera is at first, are cut away. */
const towardsEye: Position = [1, -1, 0];

export interface WholeMesh {
  /** x y z per corner of a triangle, relative to the origin. */
  readonly positions: Float32Array;
  /** Number of the element per corner. */
  readonly values: Float32Array;
}

/** Returns the outer faces of the elements after a step. `isCut`: without the elements in front of the plane. O(elements). */
export function wholeMesh(trace: Trace, step: number, isCut: boolean, origin: Position): WholeMesh {
  const all = trace.elementsAt(step);
  const outer = outerFaces(trace, isCut ? all.filter(behind(trace, all)) : all);
  const positions = new Float32Array(9 * outer.length);
  const values = new Float32Array(3 * outer.length);
  outer.forEach((face, i) => {
    cornersOfFace(trace, face).forEach((node, corner) => {
      for (let axis = 0; axis < 3; axis++)
        positions[9 * i + 3 * corner + axis] =
          (trace.nodes.positions[3 * node + axis] ?? 0) - (origin[axis] ?? 0);
    });
    values.fill(face >>> 2, 3 * i, 3 * i + 3);
  });
  return { positions, values };
}

/** Nodes of face `face`: that of number `face % 4` of element `face / 4`. */
const cornersOfFace = ({ elements }: Trace, face: number): readonly number[] =>
  (faces[face & 3] ?? faces[0]).map((corner) => elements.nodes[(face & ~3) + corner] ?? 0);

/** Returns the faces that one of the elements has alone. */
function outerFaces(trace: Trace, shown: Uint32Array): readonly number[] {
  const nodeCount = trace.nodes.positions.length / 3;
  /** Faces without a partner, by their two lowest nodes. */
  const open = new Map<number, number[]>();
  const third = (face: number): number => Math.max(...cornersOfFace(trace, face));
  for (const element of shown)
    for (let face = 4 * element; face < 4 * element + 4; face++) {
      const [a = 0, b = 0, c = 0] = cornersOfFace(trace, face);
      const [low, high] = [Math.min(a, b, c), Math.max(a, b, c)];
      const key = low * nodeCount + (a + b + c - low - high);
      const others = open.get(key);
      const partner = others?.findIndex((other) => third(other) === high) ?? -1;
      if (!others) open.set(key, [face]);
      else if (partner >= 0) others.splice(partner, 1);
      else others.push(face);
    }
  return [...open.values()].flat();
}

/** Returns a test whether the centroid of an element lies behind the plane through the middle of all. */
function behind({ elements, nodes }: Trace, all: Uint32Array): (element: number) => boolean {
  const heightOf = (element: number): number => {
    let sum = 0;
    for (const node of elements.nodes.subarray(4 * element, 4 * element + 4))
      for (let axis = 0; axis < 3; axis++)
        sum += ((nodes.positions[3 * node + axis] ?? 0) * (towardsEye[axis] ?? 0)) / 4;
    return sum;
  };
  const heights = Float64Array.from(all, heightOf);
  let [low, high] = [Infinity, -Infinity];
  for (const height of heights) [low, high] = [Math.min(low, height), Math.max(high, height)];
  const middle = (low + high) / 2;
  return (element) => heightOf(element) <= middle;
}
