/** Faces of second-order elements, as triangles near them. */
import type { CurvedEdges } from "tetrafront";
import type { Elements } from "../../document/mesh-quality";
import { faceNodes } from "./topology";

/** Number of pieces into which the edges of a curved face are divided. */
const pieces = 4;

/** Corners of the triangles of a face, three each: coordinates of the face's corners in quarters, as whole numbers. */
const pattern: readonly (readonly [number, number, number])[] = (() => {
  const corners: [number, number, number][] = [];
  const add = (i: number, j: number): number => corners.push([pieces - i - j, i, j]);
  for (let j = 0; j < pieces; ++j)
    for (let i = 0; i + j < pieces; ++i) {
      add(i, j);
      add(i + 1, j);
      add(i, j + 1);
      if (i + j + 2 > pieces) continue;
      add(i + 1, j);
      add(i + 1, j + 1);
      add(i, j + 1);
    }
  return corners;
})();
/** Number of triangles of a curved face. */
export const trianglesPerFace = pattern.length / 3;

/** Triangles to draw in place of faces. */
export interface CurvedTriangles {
  /** Per triangle: the face of which it is a part, 4t + f. */
  readonly faces: Uint32Array<ArrayBuffer>;
  /** x y z of three corners each. */
  readonly corners: Float32Array<ArrayBuffer>;
  /** Three per corner: its coordinates in the face, as multiples of `shareUnit`. */
  readonly shares: Uint8Array<ArrayBuffer>;
}

/** Multiples of this share state where a corner lies in its face. */
export const shareUnit = 1 / pieces;

/** The curved edges of a mesh, found by their nodes. */
export class CurvedFaces {
  readonly #elements: Elements;
  readonly #middles: Float64Array;
  /** Index of the middle by both nodes. */
  readonly #indexOf = new Map<number, number>();
  readonly #nodes: number;

  constructor(elements: Elements, { edges, middles }: CurvedEdges) {
    this.#elements = elements;
    this.#middles = middles;
    this.#nodes = elements.points.length / 3;
    for (let e = 0; e < edges.length / 2; ++e)
      this.#indexOf.set(this.#keyOf(edges[2 * e] ?? 0, edges[2 * e + 1] ?? 0), e);
  }

  /** Returns the triangles of faces: one of each whose edges are straight, those of the pattern of the others. */
  trianglesOf(faces: Uint32Array, origin: readonly [number, number, number]): CurvedTriangles {
    const count = faces.reduce((sum, face) => sum + (this.#isCurved(face) ? trianglesPerFace : 1), 0);
    const triangles = {
      faces: new Uint32Array(count),
      corners: new Float32Array(9 * count),
      shares: new Uint8Array(9 * count),
    };
    let triangle = 0;
    for (const face of faces) {
      const written = this.#isCurved(face) ? pattern : whole;
      const controls = this.#controlsOf(face);
      written.forEach((shares, corner) => {
        const to = 9 * triangle + 3 * corner;
        triangles.shares.set(shares, to);
        for (let axis = 0; axis < 3; ++axis)
          triangles.corners[to + axis] = quadratic(controls, shares, axis) - (origin[axis] ?? 0);
      });
      triangles.faces.fill(face, triangle, triangle + written.length / 3);
      triangle += written.length / 3;
    }
    return triangles;
  }

  #keyOf(a: number, b: number): number {
    return Math.min(a, b) * this.#nodes + Math.max(a, b);
  }

  #nodeOf(face: number, corner: number): number {
    return this.#elements.tetrahedra[(face & ~3) + (faceNodes[3 * (face & 3) + corner] ?? 0)] ?? 0;
  }

  #middleOf(face: number, corner: number): number | undefined {
    return this.#indexOf.get(this.#keyOf(this.#nodeOf(face, corner), this.#nodeOf(face, (corner + 1) % 3)));
  }

  #isCurved(face: number): boolean {
    return [0, 1, 2].some((corner) => this.#middleOf(face, corner) !== undefined);
  }

  /** Returns x y z of the three corners, then of the middles of the edges 01, 12 and 20. */
  #controlsOf(face: number): Float64Array {
    const { points } = this.#elements;
    const controls = new Float64Array(18);
    for (let corner = 0; corner < 3; ++corner) {
      const [from, to] = [this.#nodeOf(face, corner), this.#nodeOf(face, (corner + 1) % 3)];
      const middle = this.#middleOf(face, corner);
      for (let axis = 0; axis < 3; ++axis) {
        const [a, b] = [points[3 * from + axis] ?? 0, points[3 * to + axis] ?? 0];
        controls[3 * corner + axis] = a;
        controls[9 + 3 * corner + axis] =
          middle === undefined ? 0.5 * a + 0.5 * b : (this.#middles[3 * middle + axis] ?? 0);
      }
    }
    return controls;
  }
}

/** The pattern of a face that is drawn as one triangle. */
const whole: typeof pattern = [
  [pieces, 0, 0],
  [0, pieces, 0],
  [0, 0, pieces],
];

/** Returns a coordinate of the quadratic triangle with these nodes. */
function quadratic(
  controls: Float64Array,
  [i, j, k]: readonly [number, number, number],
  axis: number,
): number {
  const [u, v, w] = [i * shareUnit, j * shareUnit, k * shareUnit];
  const at = (control: number): number => controls[3 * control + axis] ?? 0;
  const corners = u * (2 * u - 1) * at(0) + v * (2 * v - 1) * at(1) + w * (2 * w - 1) * at(2);
  return corners + 4 * (u * v * at(3) + v * w * at(4) + w * u * at(5));
}
