/** Shapes that show a field inside a mesh. */
import type { Elements } from "../../document/mesh-quality";
import type { Position } from "../../document/position";
import { lengthAt } from "../../document/vectors";

/** Six edges of a tetrahedron, by its corners. */
const edgeCorners = [0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3] as const;
/** Index of the edge between two corners: `edgeBetween[4i + j]`. */
const edgeBetween = [-1, 0, 1, 2, 0, -1, 3, 4, 1, 3, -1, 5, 2, 4, 5, -1] as const;

/**
 * Returns where the linear interpolation of values at the nodes has a level: x y z of three corners per triangle, relative to
 * `origin`. In each tetrahedron, that is nothing, a triangle, or two triangles of a plane quadrilateral.
 */
export function isosurface(
  mesh: Elements,
  values: Float32Array,
  level: number,
  origin: Position,
): Float32Array<ArrayBuffer> {
  const corners: number[] = [];
  const crossings = new Float64Array(18);
  for (let first = 0; first < mesh.tetrahedra.length; first += 4) {
    const above: number[] = [];
    const below: number[] = [];
    for (let k = 0; k < 4; ++k) {
      const isAbove = (values[mesh.tetrahedra[first + k] ?? 0] ?? 0) >= level;
      (isAbove ? above : below).push(k);
    }
    if (above.length === 0 || below.length === 0) continue;
    writeCrossings(mesh, values, level, first, crossings);
    for (const edge of crossedEdges(above, below))
      for (let axis = 0; axis < 3; ++axis)
        corners.push((crossings[3 * edge + axis] ?? 0) - (origin[axis] ?? 0));
  }
  return Float32Array.from(corners);
}

/** Returns the edges at which the corners of the triangles lie, three each. */
function crossedEdges(above: readonly number[], below: readonly number[]): readonly number[] {
  const edge = (i: number, j: number): number => edgeBetween[4 * i + j] ?? 0;
  const [a = 0, b = 0] = above;
  const [c = 0, d = 0] = below;
  if (above.length === 1) return below.map((other) => edge(a, other));
  if (below.length === 1) return above.map((other) => edge(c, other));
  const round = [edge(a, c), edge(a, d), edge(b, d), edge(b, c)] as const;
  return [round[0], round[1], round[2], round[0], round[2], round[3]];
}

/** Writes where the six edges have the level, if they have it. */
function writeCrossings(
  { points, tetrahedra }: Elements,
  values: Float32Array,
  level: number,
  first: number,
  crossings: Float64Array,
): void {
  for (let edge = 0; edge < 6; ++edge) {
    const from = tetrahedra[first + (edgeCorners[2 * edge] ?? 0)] ?? 0;
    const to = tetrahedra[first + (edgeCorners[2 * edge + 1] ?? 0)] ?? 0;
    const start = values[from] ?? 0;
    const share = (level - start) / ((values[to] ?? 0) - start);
    for (let axis = 0; axis < 3; ++axis) {
      const x = points[3 * from + axis] ?? 0;
      crossings[3 * edge + axis] = x + share * ((points[3 * to + axis] ?? 0) - x);
    }
  }
}

/** Largest number of arrows. */
const maxArrows = 1500;
/** Length of the barbs of an arrow, relative to the arrow; half of the distance between their ends. */
const barb = { along: 0.25, across: 0.1 } as const;

/**
 * Returns arrows of vectors at some of the nodes: the ends of three segments each, x y z, in model coordinates. The longest
 * vector has the given length.
 */
export function arrowsOf(points: Float64Array, vectors: Float64Array, length: number): Float64Array {
  const count = points.length / 3;
  const stride = Math.max(1, Math.ceil(count / maxArrows));
  let longest = 0;
  for (let node = 0; node < count; ++node) longest = Math.max(longest, lengthAt(vectors, 3 * node, 3));
  if (longest === 0) return new Float64Array();
  const ends: number[] = [];
  for (let node = 0; node < count; node += stride) {
    const [x = 0, y = 0, z = 0] = points.subarray(3 * node, 3 * node + 3);
    const vector = vectors.subarray(3 * node, 3 * node + 3);
    const [u, v, w] = [0, 1, 2].map((axis) => ((vector[axis] ?? 0) / longest) * length) as [
      number,
      number,
      number,
    ];
    const tip = [x + u, y + v, z + w] as const;
    // Across the vector and the axis that it deviates from most.
    const across = Math.abs(w) < Math.abs(u) ? [-v, u, 0] : [0, w, -v];
    const norm = Math.hypot(...across) || 1;
    const size = (barb.across * Math.hypot(u, v, w)) / norm;
    ends.push(x, y, z, ...tip);
    for (const side of [1, -1])
      ends.push(
        ...tip,
        ...[u, v, w].map((c, axis) => (tip[axis] ?? 0) - barb.along * c + side * size * (across[axis] ?? 0)),
      );
  }
  return Float64Array.from(ends);
}
