import type { Elements } from "../../document/mesh-quality";
import type { Cut } from "../../document/selection";
import { shareUnit } from "./curved-faces";
import { faceNodes, outside } from "./topology";

export const axisIndex = { x: 0, y: 1, z: 2 } as const;

/** Returns the lowest and highest coordinate of the nodes along one axis; zeros without nodes. */
export function extentAlong(points: Float64Array, axis: Cut["axis"]): readonly [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (let i: number = axisIndex[axis]; i < points.length; i += 3) {
    const value = points[i] ?? 0;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : [0, 0];
}

/** Returns the coordinate of each tetrahedron's centroid along one axis. */
export function centroidsAlong({ points, tetrahedra }: Elements, axis: Cut["axis"]): Float32Array {
  const k = axisIndex[axis];
  const centroids = new Float32Array(tetrahedra.length / 4);
  for (let t = 0; t < centroids.length; ++t) {
    let sum = 0;
    for (let node = 4 * t; node < 4 * t + 4; ++node) sum += points[3 * (tetrahedra[node] ?? 0) + k] ?? 0;
    centroids[t] = sum / 4;
  }
  return centroids;
}

/** Sets `hidden` to 1 for the tetrahedra that a cut removes: those whose centroid lies beyond the plane. */
export function hideBeyond(
  centroids: Float32Array,
  limit: number,
  keepAbove: boolean,
  hidden: Uint8Array,
): void {
  for (let t = 0; t < centroids.length; ++t) {
    const centroid = centroids[t] ?? 0;
    if (keepAbove ? centroid < limit : centroid > limit) hidden[t] = 1;
  }
}

/** Sets `hidden` to 1 for the tetrahedra of some regions. */
export function hideRegions(
  regions: Uint32Array,
  hiddenRegions: ReadonlySet<number>,
  hidden: Uint8Array,
): void {
  if (hiddenRegions.size === 0) return;
  for (let t = 0; t < regions.length; ++t) if (hiddenRegions.has(regions[t] ?? 0)) hidden[t] = 1;
}

/**
 * Finds the visible faces: those of tetrahedra that are not hidden, if the neighbour beyond is hidden or missing.
 * Writes them as 4t + f to `faces` and returns their number. Takes about 2 ms per 100 000 tetrahedra.
 */
export function collectVisibleFaces(neighbours: Int32Array, hidden: Uint8Array, faces: Uint32Array): number {
  let count = 0;
  for (let t = 0; 4 * t < neighbours.length; ++t) {
    if (hidden[t] === 1) continue;
    for (let face = 4 * t; face < 4 * t + 4; ++face) {
      const beyond = neighbours[face] ?? outside;
      if (beyond === outside || hidden[beyond] === 1) faces[count++] = face;
    }
  }
  return count;
}

/** Writes the three corners of each face, x y z relative to `origin`. */
export function writeCorners(
  { points, tetrahedra }: Elements,
  faces: Uint32Array,
  count: number,
  origin: readonly [number, number, number],
  corners: Float32Array,
): void {
  let out = 0;
  for (let i = 0; i < count; ++i) {
    const face = faces[i] ?? 0;
    const base = face & ~3;
    const local = 3 * (face & 3);
    for (let corner = local; corner < local + 3; ++corner) {
      const at = 3 * (tetrahedra[base + (faceNodes[corner] ?? 0)] ?? 0);
      corners[out++] = (points[at] ?? 0) - origin[0];
      corners[out++] = (points[at + 1] ?? 0) - origin[1];
      corners[out++] = (points[at + 2] ?? 0) - origin[2];
    }
  }
}

/** One value per node or element, and the values at the two ends of the colour scale. */
export interface FieldValues {
  readonly values: Float32Array<ArrayBuffer>;
  readonly isPerElement: boolean;
  readonly range: readonly [low: number, high: number];
  /** x y z per node by which it is drawn away from its position; null for none. */
  readonly offsets: Float32Array<ArrayBuffer> | null;
}

/** Returns the function from a value to its position on the colour scale. If all values are equal, they have the colour in the middle. */
export function scaleOf([low, high]: FieldValues["range"]): (value: number) => number {
  const scale = high > low ? 1 / (high - low) : 0;
  return (value) => (scale === 0 ? 0.5 : (value - low) * scale);
}

/**
 * Returns the position on the colour scale per corner of each triangle: 0 to 1. `shares` as in `CurvedTriangles`; empty if every
 * triangle is a face.
 */
export function cornerValues(
  tetrahedra: Uint32Array,
  faces: Uint32Array,
  shares: Uint8Array,
  { values, isPerElement, range }: FieldValues,
): Float32Array<ArrayBuffer> {
  const positions = new Float32Array(3 * faces.length);
  const positionOf = scaleOf(range);
  const ofFace = [0, 0, 0];
  for (let i = 0; i < faces.length; ++i) {
    const face = faces[i] ?? 0;
    for (let k = 0; k < 3; ++k) {
      const node = tetrahedra[(face & ~3) + (faceNodes[3 * (face & 3) + k] ?? 0)] ?? 0;
      ofFace[k] = positionOf(values[isPerElement ? face >> 2 : node] ?? 0);
    }
    for (let k = 0; k < 3; ++k)
      positions[3 * i + k] =
        shares.length === 0
          ? (ofFace[k] ?? 0)
          : meanOf(ofFace, shares.subarray(9 * i + 3 * k, 9 * i + 3 * k + 3));
  }
  return positions;
}

const meanOf = (values: readonly number[], shares: Uint8Array): number =>
  shares.reduce((sum, share, k) => sum + share * shareUnit * (values[k] ?? 0), 0);

/** The triangles of a mesh to draw, in flat arrays. */
export interface DrawnFaces {
  /** Per triangle 4t + f: face f of tetrahedron t, opposite its node f. A curved face has several triangles. */
  readonly faces: Uint32Array<ArrayBuffer>;
  /** Per triangle: 1 if it lies on the boundary of its region, 0 if only the cut exposes it. */
  readonly onBoundary: Uint8Array<ArrayBuffer>;
  /** Nine per triangle: x y z of three corners, counter-clockwise from outside. */
  readonly corners: Float32Array<ArrayBuffer>;
  /** Three per corner: its coordinates in its face, as multiples of `shareUnit`; empty if every triangle is a face. */
  readonly shares: Uint8Array<ArrayBuffer>;
  readonly shareUnit: number;
  /**
   * Per corner: the position of its element on the colour scale, 0 to 1, or the index of its region, depending on
   * the shading; empty with plain shading. With a field, the position of its own value.
   */
  readonly values: Float32Array<ArrayBuffer>;
}
