/**
 * A block of tetrahedra whose patches and regions have difficult names and tags, for tests of file formats.
 */
import type { Mesh } from "tetrafront";

type Triple = readonly [number, number, number];

/** One patch per side of the block. Formats must change some names, and the tags are not in order. */
const PATCHES = [
  { name: "in let", tag: 7 },
  { name: "outlet", tag: 3 },
  { name: "5th wall", tag: 11 },
  { name: "outlet", tag: 4 },
  { name: "floor, cold", tag: 21 },
  { name: "", tag: 2 },
] as const;
const REGIONS = [
  { name: "steel", tag: 5 },
  { name: "water (20 C)", tag: 9 },
] as const;

/**
 * The six tetrahedra of a cube around its diagonal (Kuhn): each permutation is the order of steps along the
 * axes.
 */
const AXIS_ORDERS: readonly Triple[] = [
  [0, 1, 2],
  [1, 2, 0],
  [2, 0, 1],
  [0, 2, 1],
  [2, 1, 0],
  [1, 0, 2],
];

/** Returns n × n × n cubes of six tetrahedra; the lower half is one region, the upper half another. */
export function blockMesh(n = 2): Mesh {
  const m = n + 1;
  const node = (p: Triple) => p[0] + m * (p[1] + m * p[2]);
  const points: number[] = [];
  for (let z = 0; z < m; z++) {
    for (let y = 0; y < m; y++) {
      // Multiples of 1/3 and 0.1 need all digits to be read back exactly.
      for (let x = 0; x < m; x++) points.push(x / 3, 0.1 * y + 0.2, 0 - 1e-3 * z);
    }
  }
  const tetrahedra: number[] = [];
  const tetrahedronRegion: number[] = [];
  const sides: number[][] = PATCHES.map(() => []);
  for (let z = 0; z < n; z++) {
    for (let y = 0; y < n; y++) {
      for (let x = 0; x < n; x++) {
        for (const axes of AXIS_ORDERS) {
          const at = [x, y, z] as [number, number, number];
          const path: Triple[] = [[...at]];
          for (const axis of axes) {
            at[axis] = (at[axis] ?? 0) + 1;
            path.push([...at]);
          }
          const corners = path.map(node) as [number, number, number, number];
          const [a, b, c, d] = corners;
          const isPositive = sixfoldVolume(points, corners) > 0;
          tetrahedra.push(...(isPositive ? [a, b, c, d] : [b, a, c, d]));
          tetrahedronRegion.push(2 * z < n ? 0 : 1);
        }
      }
    }
  }
  for (const face of outerFaces(tetrahedra)) {
    const side = sideOf(
      face.map((p) => gridPosition(p, m)),
      n,
    );
    sides[side]?.push(...face);
  }
  return {
    points: Float64Array.from(points),
    triangles: Uint32Array.from(sides.flat()),
    trianglePatch: Uint32Array.from(
      sides.flatMap((own, patch) => Array.from({ length: own.length / 3 }, () => patch)),
    ),
    patches: PATCHES,
    tetrahedra: Uint32Array.from(tetrahedra),
    tetrahedronRegion: Uint32Array.from(tetrahedronRegion),
    regions: REGIONS,
    nodeData: new Map(),
  };
}

function gridPosition(node: number, m: number): Triple {
  return [node % m, Math.floor(node / m) % m, Math.floor(node / (m * m))];
}

function sideOf(corners: readonly Triple[], n: number): number {
  for (let axis = 0; axis < 3; axis++) {
    if (corners.every((corner) => corner[axis] === 0)) return 2 * axis;
    if (corners.every((corner) => corner[axis] === n)) return 2 * axis + 1;
  }
  throw new Error("a face is on no side");
}

/** Returns the faces that only one tetrahedron has, counter-clockwise seen from outside. */
export function outerFaces(tetrahedra: ArrayLike<number>): Triple[] {
  const faces = new Map<string, Triple[]>();
  for (const face of facesOf(tetrahedra)) {
    const key = [...face].sort((a, b) => a - b).join(" ");
    faces.set(key, [...(faces.get(key) ?? []), face]);
  }
  return [...faces.values()].flatMap((sides) => (sides.length === 1 ? sides : []));
}

/** Returns the four faces of each tetrahedron, counter-clockwise seen from outside. */
function facesOf(tetrahedra: ArrayLike<number>): Triple[] {
  const faces: Triple[] = [];
  for (let t = 0; t < tetrahedra.length; t += 4) {
    const [a = 0, b = 0, c = 0, d = 0] = Array.from({ length: 4 }, (_, i) => tetrahedra[t + i] ?? 0);
    faces.push([a, c, b], [a, b, d], [b, c, d], [a, d, c]);
  }
  return faces;
}

export function sixfoldVolume(points: ArrayLike<number>, corners: readonly number[]): number {
  const [a = 0, b = 0, c = 0, d = 0] = corners;
  const side = (to: number) =>
    [0, 1, 2].map((axis) => (points[3 * to + axis] ?? 0) - (points[3 * a + axis] ?? 0));
  const [u, v, w] = [side(b), side(c), side(d)] as [number[], number[], number[]];
  const at = (row: readonly number[], axis: number) => row[axis % 3] ?? 0;
  return [0, 1, 2].reduce(
    (sum, i) => sum + at(w, i) * (at(u, i + 1) * at(v, i + 2) - at(u, i + 2) * at(v, i + 1)),
    0,
  );
}

/**
 * Returns each element with the tag of its group, sorted, so that the order of elements and groups does not
 * matter.
 */
export function taggedElements(
  nodes: ArrayLike<number>,
  width: number,
  owners: ArrayLike<number>,
  groups: readonly { readonly tag: number }[],
): string[] {
  return Array.from({ length: nodes.length / width }, (_, e) => {
    const corners = Array.from({ length: width }, (__, i) => nodes[width * e + i] ?? NaN);
    return `${groups[owners[e] ?? 0]?.tag}: ${corners.join(" ")}`;
  }).sort();
}
