/**
 * An independent check of tetrahedral meshes. It shares no code with the mesher: faces are paired by sorting,
 * signs are exact, and volumes come from the divergence theorem.
 */
import { type Mesh, NO_REGION } from "tetrafront";

import { orientation } from "./exact.js";

/** Numbers of defects of a mesh, all zero if it is valid. */
export interface MeshDefects {
  /** Coordinates that are not finite, and node indices out of range. */
  readonly broken: number;
  /** Tetrahedra of zero or negative volume. */
  readonly notPositive: number;
  /** Faces of more than two tetrahedra. */
  readonly crowdedFaces: number;
  /** Faces whose tetrahedra lie on the same side. */
  readonly sameSideFaces: number;
  /** Triangles of the surface that are not boundary faces of the mesh with the same orientation. */
  readonly missingTriangles: number;
  /** Boundary faces of the mesh that are not triangles of the surface. */
  readonly extraFaces: number;
  /** Nodes at the position of another node. */
  readonly doubleNodes: number;
  /** Nodes that no tetrahedron uses. */
  readonly unusedNodes: number;
}

export const NO_DEFECTS: MeshDefects = {
  broken: 0,
  notPositive: 0,
  crowdedFaces: 0,
  sameSideFaces: 0,
  missingTriangles: 0,
  extraFaces: 0,
  doubleNodes: 0,
  unusedNodes: 0,
};

/** Tetrahedra, and the region of each if there are several. */
export type Elements = Pick<Mesh, "points" | "tetrahedra"> & Partial<Pick<Mesh, "tetrahedronRegion">>;
/** Triangles, and the regions on their sides if there are interfaces. */
export type Boundary = Pick<Mesh, "points" | "triangles"> & Pick<Mesh, "triangleRegions">;

type Tetrahedron = readonly [number, number, number, number];
type Triangle = readonly [number, number, number];

/**
 * Compares a mesh with the surface that bounds it; nodes are matched by their coordinates. An interface must
 * have faces on both sides, each in the region that the surface gives.
 */
export function defectsOf(mesh: Elements, surface: Boundary): MeshDefects {
  const { points } = mesh;
  const nodeCount = points.length / 3;
  const tetrahedra = rows(mesh.tetrahedra, 4) as unknown as Tetrahedron[];
  const broken =
    points.filter((value) => !Number.isFinite(value)).length +
    mesh.tetrahedra.filter((node) => node >= nodeCount).length;
  const faces = new FaceTable(nodeCount);
  for (const [t, tetrahedron] of tetrahedra.entries())
    for (const face of outwardFaces(tetrahedron)) faces.add(face, mesh.tetrahedronRegion?.[t] ?? 0);
  const nodeAt = new Map(rows(points, 3).map((position, node) => [positionKey(position), node]));
  const expected = rows(surface.triangles, 3).map((triangle) =>
    triangle.map((node) => nodeAt.get(positionKey(surface.points.subarray(3 * node, 3 * node + 3))) ?? NaN),
  ) as unknown as Triangle[];
  const boundary = faces.boundary();
  const expectedKeys = new Set(
    expected.flatMap((triangle, t) => {
      const key = faces.key(triangle);
      return isInterface(surface, t) ? [key, faces.reverse(key)] : [key];
    }),
  );
  return {
    broken,
    notPositive: tetrahedra.filter((tetrahedron) => orientation(points, tetrahedron) <= 0).length,
    crowdedFaces: faces.crowded,
    sameSideFaces: faces.sameSide(),
    missingTriangles: [...expectedKeys].filter((key) => !boundary.has(key)).length,
    extraFaces: [...boundary].filter((key) => !expectedKeys.has(key)).length,
    doubleNodes: nodeCount - nodeAt.size,
    unusedNodes: nodeCount - new Set(mesh.tetrahedra).size,
  };
}

function isInterface({ triangleRegions }: Boundary, triangle: number): boolean {
  return triangleRegions !== undefined && triangleRegions[2 * triangle + 1] !== NO_REGION;
}

/** Returns the volume that a closed surface encloses, by the divergence theorem about its first node. */
export function enclosedVolume(surface: Boundary): number {
  const terms = rows(surface.triangles, 3).map(([a = 0, b = 0, c = 0], t) =>
    isInterface(surface, t) ? 0 : sixVolumes(surface.points, [0, a, b, c]),
  );
  return preciseSum(terms) / 6;
}

/** Returns the volume of each region of a surface with regions. */
export function regionVolumes({
  points,
  triangles,
  triangleRegions = new Uint32Array(),
}: Boundary): number[] {
  const terms: number[][] = [];
  for (const [side, region] of triangleRegions.entries()) {
    if (region === NO_REGION) continue;
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * (side >> 1));
    const volume = sixVolumes(points, [0, a, b, c]);
    (terms[region] ??= []).push(side % 2 === 0 ? volume : -volume);
  }
  return terms.map((ofRegion) => preciseSum(ofRegion) / 6);
}

export function tetrahedronVolumes({ points, tetrahedra }: Elements): number[] {
  return rows(tetrahedra, 4).map((nodes) => sixVolumes(points, nodes as unknown as Tetrahedron) / 6);
}

export function meshVolume(mesh: Elements): number {
  return preciseSum(tetrahedronVolumes(mesh));
}

/** Counts faces by their nodes; the key keeps the orientation. */
class FaceTable {
  readonly #counts = new Map<number, number>();
  readonly #regions = new Map<number, number>();
  readonly #base: number;
  crowded = 0;

  constructor(nodeCount: number) {
    if (nodeCount ** 3 > Number.MAX_SAFE_INTEGER) throw new Error("too many nodes for number keys");
    this.#base = nodeCount;
  }

  /**
   * Returns a key that is equal for all rotations of the three nodes and different for the opposite
   * orientation.
   */
  key([a, b, c]: Triangle): number {
    const [x, y, z] = a < b && a < c ? [a, b, c] : b < c ? [b, c, a] : [c, a, b];
    return (x * this.#base + y) * this.#base + z;
  }

  add(face: Triangle, region: number): void {
    const key = this.key(face);
    const count = (this.#counts.get(key) ?? 0) + 1;
    this.#counts.set(key, count);
    this.#regions.set(key, region);
    if (count + (this.#counts.get(this.reverse(key)) ?? 0) > 2) this.crowded++;
  }

  sameSide(): number {
    return [...this.#counts.values()].filter((count) => count > 1).length;
  }

  /** Returns the keys of the faces on the boundary of a region. */
  boundary(): Set<number> {
    const ends = (key: number) => this.#regions.get(this.reverse(key)) !== this.#regions.get(key);
    return new Set([...this.#counts.keys()].filter(ends));
  }

  reverse(key: number): number {
    const z = key % this.#base;
    const y = Math.floor(key / this.#base) % this.#base;
    const x = Math.floor(key / this.#base / this.#base);
    return this.key([x, z, y]);
  }
}

function outwardFaces([a, b, c, d]: Tetrahedron): Triangle[] {
  return [
    [b, c, d],
    [a, d, c],
    [a, b, d],
    [a, c, b],
  ];
}

function sixVolumes(points: Float64Array, [a, b, c, d]: Tetrahedron): number {
  const edge = (node: number, axis: number) =>
    (points[3 * node + axis] ?? NaN) - (points[3 * a + axis] ?? NaN);
  const [ux, uy, uz] = [edge(b, 0), edge(b, 1), edge(b, 2)];
  const [vx, vy, vz] = [edge(c, 0), edge(c, 1), edge(c, 2)];
  const [wx, wy, wz] = [edge(d, 0), edge(d, 1), edge(d, 2)];
  return (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz;
}

/** Sums with compensation for rounding (Kahan–Neumaier). */
function preciseSum(terms: readonly number[]): number {
  let sum = 0;
  let lost = 0;
  for (const term of terms) {
    const next = sum + term;
    lost += Math.abs(sum) >= Math.abs(term) ? sum - next + term : term - next + sum;
    sum = next;
  }
  return sum + lost;
}

function positionKey(position: ArrayLike<number>): string {
  return Array.from(position, (value) => value + 0).join(" ");
}

function rows(values: Float64Array | Uint32Array, width: number): number[][] {
  return Array.from({ length: values.length / width }, (_, row) => [
    ...values.subarray(width * row, width * (row + 1)),
  ]);
}
