import type { Mesh } from "tetrafront";
import type { MetricShapes } from "tetrafront/internal";
import type { Project } from "tetrafront/project";

/** The measures a mesh can be shaded by. Both are per tetrahedron, higher is better. */
export type QualityMeasure = "radius-ratio" | "dihedral";

/** Best value of each measure: the regular tetrahedron has ratio 1 and angles of arccos(1/3). */
export const bestValue: { readonly [M in QualityMeasure]: number } = {
  "radius-ratio": 1,
  dihedral: 70.528779,
};

/** Value at which the colour scale begins. All lower values have its darkest colour. */
export const worstShown: { readonly [M in QualityMeasure]: number } = {
  "radius-ratio": 0.2,
  dihedral: 10,
};

/** Returns where a value lies on the colour scale: 0 to 1 if it is within the scale. */
export function scalePosition(value: number, measure: QualityMeasure): number {
  return (value - worstShown[measure]) / (bestValue[measure] - worstShown[measure]);
}

/**
 * Where shapes are measured. In the metric of a stretched background grid, the target element is regular with edges of
 * length 1. In space, elements are measured as they are drawn.
 */
export type QualitySpace = "metric" | "space";

/** Returns whether the background grid asks for stretched elements. */
export function asksForStretching({ background, meshing }: Project): boolean {
  return (
    meshing?.size === undefined &&
    background.nodes.some(
      ({ stretching = 1, secondStretching = 1 }) => stretching > 1 || secondStretching > 1,
    )
  );
}

/** The part of a mesh that quality in space depends on. */
export type Elements = Pick<Mesh, "points" | "tetrahedra">;

/** Mesh whose quality is also known in its metric, if that is stretched. */
export interface MeasuredMesh {
  readonly mesh: Elements;
  readonly metricShapes?: MetricShapes | undefined;
}

/** Returns the quality of one tetrahedron in space, given its index in the mesh. */
export function qualityOf(mesh: Elements, measure: QualityMeasure, tetrahedron: number): number {
  return functionOf(measure)(mesh, tetrahedron);
}

/** Returns the quality of one tetrahedron, given its index in the mesh. Without a stretched metric, in space. */
export function qualityIn(
  { mesh, metricShapes }: MeasuredMesh,
  space: QualitySpace,
  measure: QualityMeasure,
  tetrahedron: number,
): number {
  const known = space === "metric" ? metricShapes : undefined;
  return known ? (metricValues(known, measure)[tetrahedron] ?? 0) : qualityOf(mesh, measure, tetrahedron);
}

/** Returns the measure of every tetrahedron in the metric. */
export function metricValues(shapes: MetricShapes, measure: QualityMeasure): Float32Array {
  return measure === "radius-ratio" ? shapes.radiusRatio : shapes.smallestDihedral;
}

/**
 * Returns the measure of every tetrahedron. O(tetrahedra), about 0.2 s for a million, so call it in a worker.
 */
export function qualitiesOf(mesh: Elements, measure: QualityMeasure): Float32Array {
  const quality = functionOf(measure);
  const values = new Float32Array(mesh.tetrahedra.length / 4);
  for (let t = 0; t < values.length; ++t) values[t] = quality(mesh, t);
  return values;
}

function functionOf(measure: QualityMeasure): (mesh: Elements, tetrahedron: number) => number {
  return measure === "radius-ratio" ? radiusRatio : smallestDihedral;
}

/** Scratch memory, for one element at a time. */
const edges = new Float64Array(9);
const normals = new Float64Array(12);

const length = (x: number, y: number, z: number): number => Math.sqrt(x * x + y * y + z * z);

/** Coordinates of three edge vectors from the first node, in the order a b c, each x y z. */
function findEdges({ points, tetrahedra }: Elements, tetrahedron: number): void {
  const base = 3 * (tetrahedra[4 * tetrahedron] ?? 0);
  for (let k = 0; k < 3; ++k) {
    const node = 3 * (tetrahedra[4 * tetrahedron + k + 1] ?? 0);
    for (let axis = 0; axis < 3; ++axis) {
      edges[3 * k + axis] = (points[node + axis] ?? 0) - (points[base + axis] ?? 0);
    }
  }
}

/**
 * 3 × inradius / circumradius. With edge vectors a b c from one node, 6V = a·(b×c), inradius = 3V / area,
 * circumradius = |a²(b×c) + b²(c×a) + c²(a×b)| / 12V.
 */
function radiusRatio(mesh: Elements, tetrahedron: number): number {
  findEdges(mesh, tetrahedron);
  const [ax = 0, ay = 0, az = 0, bx = 0, by = 0, bz = 0, cx = 0, cy = 0, cz = 0] = edges;
  const bcX = by * cz - bz * cy;
  const bcY = bz * cx - bx * cz;
  const bcZ = bx * cy - by * cx;
  const caX = cy * az - cz * ay;
  const caY = cz * ax - cx * az;
  const caZ = cx * ay - cy * ax;
  const abX = ay * bz - az * by;
  const abY = az * bx - ax * bz;
  const abZ = ax * by - ay * bx;
  const a2 = ax * ax + ay * ay + az * az;
  const b2 = bx * bx + by * by + bz * bz;
  const c2 = cx * cx + cy * cy + cz * cz;
  const sixVolumes = ax * bcX + ay * bcY + az * bcZ;
  const doubleArea =
    length(bcX, bcY, bcZ) +
    length(caX, caY, caZ) +
    length(abX, abY, abZ) +
    length(abX + bcX + caX, abY + bcY + caY, abZ + bcZ + caZ);
  const numerator = length(
    a2 * bcX + b2 * caX + c2 * abX,
    a2 * bcY + b2 * caY + c2 * abY,
    a2 * bcZ + b2 * caZ + c2 * abZ,
  );
  return (6 * sixVolumes * sixVolumes) / (doubleArea * numerator);
}

/** Returns the smallest of the six dihedral angles, in degrees. */
function smallestDihedral(mesh: Elements, tetrahedron: number): number {
  findEdges(mesh, tetrahedron);
  findNormals();
  let largestCosine = -1;
  for (let i = 0; i < 4; ++i) {
    for (let j = 0; j < i; ++j) {
      const cosine =
        -(normals[3 * i] ?? 0) * (normals[3 * j] ?? 0) -
        (normals[3 * i + 1] ?? 0) * (normals[3 * j + 1] ?? 0) -
        (normals[3 * i + 2] ?? 0) * (normals[3 * j + 2] ?? 0);
      largestCosine = Math.max(largestCosine, cosine);
    }
  }
  return (Math.acos(Math.min(1, largestCosine)) * 180) / Math.PI;
}

/** Unit outward normals of the four faces: three through the first node, then the opposite one. */
function findNormals(): void {
  for (let face = 0; face < 3; ++face) {
    const p = 3 * face;
    const q = 3 * ((face + 1) % 3);
    for (let axis = 0; axis < 3; ++axis) {
      const u = (axis + 1) % 3;
      const v = (axis + 2) % 3;
      normals[p + axis] =
        (edges[q + u] ?? 0) * (edges[p + v] ?? 0) - (edges[q + v] ?? 0) * (edges[p + u] ?? 0);
    }
  }
  for (let axis = 0; axis < 3; ++axis) {
    normals[9 + axis] = -((normals[axis] ?? 0) + (normals[3 + axis] ?? 0) + (normals[6 + axis] ?? 0));
  }
  for (let p = 0; p < 12; p += 3) {
    const long = length(normals[p] ?? 0, normals[p + 1] ?? 0, normals[p + 2] ?? 0) || 1;
    for (let axis = 0; axis < 3; ++axis) normals[p + axis] = (normals[p + axis] ?? 0) / long;
  }
}

export interface Histogram {
  /** Number of tetrahedra per bar; bar i covers [i, i + 1) / bars.length of `best`. */
  readonly bars: readonly number[];
  readonly best: number;
  readonly min: number;
  readonly mean: number;
}

/** Returns the distribution of the values. */
export function histogramOf(values: Float32Array, measure: QualityMeasure, barCount: number): Histogram {
  const best = bestValue[measure];
  const bars = new Array<number>(barCount).fill(0);
  let min = Infinity;
  let sum = 0;
  for (const value of values) {
    const bar = Math.min(barCount - 1, Math.max(0, Math.floor((value / best) * barCount)));
    bars[bar] = (bars[bar] ?? 0) + 1;
    min = Math.min(min, value);
    sum += value;
  }
  return { bars, best, min: values.length > 0 ? min : 0, mean: values.length > 0 ? sum / values.length : 0 };
}
