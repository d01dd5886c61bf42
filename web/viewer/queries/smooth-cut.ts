/**
 * A cut through elements instead of between them: their sections with a plane, and what it leaves of their faces. Positions and
 * values at the corners are interpolated along the edges that the plane divides.
 */
import type { Elements } from "../../document/mesh-quality";
import type { Position } from "../../document/position";
import type { Cut } from "../../document/selection";
import { faceNodes, outside } from "./topology";
import {
  axisIndex,
  cornerValues,
  scaleOf,
  writeCorners,
  type DrawnFaces,
  type FieldValues,
} from "./visible-faces";

/** Parts of faces, and sections. A corner at a node has the index of the node twice. */
interface CutCorners {
  /** Per triangle: the face that it is a part of, 4t + f; of the section of tetrahedron t, 4t. */
  readonly faces: number[];
  /** Per triangle: 1 if it is a part of a section. */
  readonly isSection: number[];
  /** Two per corner: the ends of its edge. */
  readonly ends: number[];
  /** Per corner: distance from the first end / length of the edge. */
  readonly positions: number[];
  /** Three per corner: its coordinates in the face, in multiples of `1 / whole`. Only edges of the mesh have a zero all along. */
  readonly shares: number[];
}

const whole = 255;
/** The mesh before the cut. */
interface UncutMesh {
  readonly mesh: Elements;
  /** Per face 4t + f: the tetrahedron beyond. */
  readonly neighbours: Int32Array;
  /** Per tetrahedron: 1 if it is not drawn. */
  readonly hidden: Uint8Array;
  /** Space for an entry per face 4t + f. */
  readonly scratch: Uint32Array;
}

/** The part beyond the plane is cut away: that above the coordinate, or that below if flipped. */
interface CutPlane extends Pick<Cut, "axis" | "flipped"> {
  readonly limit: number;
}

/** Returns what the plane of a cut leaves of a mesh, with the section of each element that it meets. Nodes are drawn at `points`. */
export function cutSmoothly(
  uncut: UncutMesh,
  plane: CutPlane,
  field: FieldValues,
  { points, origin }: { readonly points: Float64Array; readonly origin: Position },
): Omit<DrawnFaces, "onBoundary"> & { readonly isSection: (triangle: number) => boolean } {
  const { mesh, scratch } = uncut;
  const divided = { ...uncut, tetrahedra: mesh.tetrahedra, heights: heightsOver(mesh.points, plane) };
  const { wholeCount, cut } = cutElements(divided, scratch);
  const faces = new Uint32Array(wholeCount + cut.faces.length);
  faces.set(scratch.subarray(0, wholeCount));
  faces.set(cut.faces, wholeCount);
  const corners = new Float32Array(9 * faces.length);
  writeCorners({ points, tetrahedra: mesh.tetrahedra }, faces, wholeCount, origin, corners);
  const positions = interpolated(cut, points, 3).map((x, i) => x - (origin[i % 3] ?? 0));
  corners.set(positions, 9 * wholeCount);
  const shares = new Uint8Array(9 * faces.length);
  for (let i = 0; i < wholeCount; ++i) shares.set(cornerShares.flat(), 9 * i);
  shares.set(cut.shares, 9 * wholeCount);
  const values = new Float32Array(3 * faces.length);
  values.set(cornerValues(mesh.tetrahedra, faces.subarray(0, wholeCount), new Uint8Array(), field));
  values.set(interpolated(cut, field.values, 1).map(scaleOf(field.range)), 3 * wholeCount);
  const isSection = (triangle: number): boolean => cut.isSection[triangle - wholeCount] === 1;
  return { faces, corners, shares, shareUnit: 1 / whole, values, isSection };
}

/** Returns the distance of each node from a plane; negative where it is cut away. */
function heightsOver(points: Float64Array, { axis, flipped, limit }: CutPlane): Float64Array {
  const heights = new Float64Array(points.length / 3);
  for (let node = 0; node < heights.length; ++node) {
    const above = (points[3 * node + axisIndex[axis]] ?? 0) - limit;
    heights[node] = flipped ? above : -above;
  }
  return heights;
}

/** What decides which elements remain. */
interface DividedMesh extends Omit<UncutMesh, "mesh" | "scratch"> {
  readonly tetrahedra: Uint32Array;
  /** Per node: distance from the plane; negative where it is cut away. */
  readonly heights: Float64Array;
}

interface Corner {
  readonly from: number;
  readonly to: number;
  readonly position: number;
  readonly share: readonly [number, number, number];
}

/**
 * Finds what a plane leaves of a mesh. Writes the visible faces that it leaves whole to `faces` as 4t + f, and returns their number
 * and all other triangles. O(elements).
 */
function cutElements(
  mesh: DividedMesh,
  faces: Uint32Array,
): { readonly wholeCount: number; readonly cut: CutCorners } {
  const { tetrahedra, neighbours, hidden, heights } = mesh;
  const cut: CutCorners = { faces: [], isSection: [], ends: [], positions: [], shares: [] };
  let wholeCount = 0;
  for (let t = 0; 4 * t < tetrahedra.length; ++t) {
    if (hidden[t] === 1) continue;
    let kept = 0;
    for (let k = 0; k < 4; ++k) if ((heights[tetrahedra[4 * t + k] ?? 0] ?? 0) >= 0) kept |= 1 << k;
    if (kept === 0) continue;
    for (let f = 0; f < 4; ++f) {
      const beyond = neighbours[4 * t + f] ?? outside;
      if (beyond !== outside && hidden[beyond] !== 1) continue;
      const corners = 15 & ~(1 << f);
      if ((kept & corners) === corners) faces[wholeCount++] = 4 * t + f;
      else if ((kept & corners) !== 0) addPart(mesh, cut, 4 * t + f);
    }
    if (kept !== 15) addSection(mesh, cut, t, kept);
  }
  return { wholeCount, cut };
}

/** Returns where the plane divides the edge between two nodes. */
function crossing({ heights }: DividedMesh, from: number, to: number): number {
  const height = heights[from] ?? 0;
  return height / (height - (heights[to] ?? 0));
}

function addTriangle(cut: CutCorners, face: number, isSection: boolean, corners: readonly Corner[]): void {
  cut.faces.push(face);
  cut.isSection.push(isSection ? 1 : 0);
  for (const { from, to, position, share } of corners) {
    cut.ends.push(from, to);
    cut.positions.push(position);
    cut.shares.push(...share);
  }
}

const cornerShares = [
  [whole, 0, 0],
  [0, whole, 0],
  [0, 0, whole],
] as const;

/** Adds the part of a face that is not cut away: a triangle, or two of a quadrilateral. */
function addPart(mesh: DividedMesh, cut: CutCorners, face: number): void {
  const local = 3 * (face & 3);
  const nodes = [0, 1, 2].map((k) => mesh.tetrahedra[(face & ~3) + (faceNodes[local + k] ?? 0)] ?? 0);
  const isKept = (node: number): boolean => (mesh.heights[node] ?? 0) >= 0;
  const corners: Corner[] = [];
  nodes.forEach((from, k) => {
    const next = (k + 1) % 3;
    const to = nodes[next] ?? 0;
    const [own = cornerShares[0], other = own] = [cornerShares[k], cornerShares[next]];
    if (isKept(from)) corners.push({ from, to: from, position: 0, share: own });
    if (isKept(from) === isKept(to)) return;
    const position = crossing(mesh, from, to);
    const at = (i: 0 | 1 | 2): number => Math.round(own[i] + position * (other[i] - own[i]));
    corners.push({ from, to, position, share: [at(0), at(1), at(2)] });
  });
  for (let k = 2; k < corners.length; ++k)
    addTriangle(
      cut,
      face,
      false,
      [corners[0], corners[k - 1], corners[k]].flatMap((corner) => corner ?? []),
    );
}

const half = Math.round(whole / 2);
/** Coordinates of the corners of a triangle, and of the two triangles of a quadrilateral, whose diagonal is no edge. */
const sectionShares = {
  triangle: cornerShares,
  quadrilateral: [
    [[whole, half, 0], [0, whole, 0], [0, half, whole]],
    [[whole, 0, half], [0, whole, half], [0, 0, whole]],
  ],
} as const; // prettier-ignore

/** Adds the section of a tetrahedron, counter-clockwise seen from what is cut away. `kept`: bit k is set if node k is. */
function addSection(mesh: DividedMesh, cut: CutCorners, t: number, kept: number): void {
  const all = [0, 1, 2, 3];
  const inside = all.filter((k) => (kept & (1 << k)) !== 0);
  const beyond = all.filter((k) => (kept & (1 << k)) === 0);
  const at = (from: number, to: number) => {
    const [a = 0, b = 0] = [mesh.tetrahedra[4 * t + from], mesh.tetrahedra[4 * t + to]];
    return { from: a, to: b, position: crossing(mesh, a, b) };
  };
  const [a = 0, b = 0] = inside;
  const [c = 0, d = 0] = beyond;
  if (inside.length === 2) {
    const round = [at(a, c), at(a, d), at(b, d), at(b, c)];
    // The corners a b c d are an odd permutation of the nodes if 0 and 2 are on one side.
    if (kept === 5 || kept === 10) round.reverse();
    sectionShares.quadrilateral.forEach((shares, half) => {
      const corners = [round[0], round[1 + half], round[2 + half]];
      addTriangle(cut, 4 * t, true, withShares(corners, shares));
    });
    return;
  }
  const apex = inside.length === 1 ? a : c;
  const others = faceNodes.slice(3 * apex, 3 * apex + 3).map((other) => at(apex, other));
  if (inside.length === 3) others.reverse();
  addTriangle(cut, 4 * t, true, withShares(others, sectionShares.triangle));
}

const withShares = (
  corners: readonly (Omit<Corner, "share"> | undefined)[],
  shares: readonly Corner["share"][],
): readonly Corner[] =>
  corners.flatMap((corner, k) => (corner ? [{ ...corner, share: shares[k] ?? cornerShares[0] }] : []));

/** Returns numbers at the corners from `components` per node. */
function interpolated(
  { ends, positions }: CutCorners,
  values: ArrayLike<number>,
  components: number,
): Float64Array {
  const result = new Float64Array(components * positions.length);
  positions.forEach((position, corner) => {
    const [from = 0, to = 0] = [ends[2 * corner], ends[2 * corner + 1]];
    for (let k = 0; k < components; ++k) {
      const start = values[components * from + k] ?? 0;
      result[components * corner + k] = start + position * ((values[components * to + k] ?? 0) - start);
    }
  });
  return result;
}
