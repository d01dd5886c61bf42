import type { PreparedBody, Project, ProjectPreview } from "tetrafront";
import { rangeAlong } from "./extent";
import type { Position } from "./position";
import type { SizePlane } from "./selection";

/** Positions at which sizes are shown, joined by segments and triangles. */
export interface SizeSurface {
  /** x y z per position. */
  readonly points: Float64Array;
  /** Two indices per segment. */
  readonly segments: Uint32Array;
  /** Three indices per triangle of the patches, and of the plane. */
  readonly triangles: Uint32Array;
  readonly plane: Uint32Array;
  /** Ids of the bodies that the triangles cover. */
  readonly bodies: readonly number[];
}

/** The treated triangles of a body, at their position. */
export type SizedBody = Pick<PreparedBody, "body" | "points" | "triangles">;

/** Longest edge of a piece of a line or patch, relative to the diagonal of the model. */
const pieceShare = 1 / 40;
/** Lines between the positions on the plane, in each direction. */
const planeDivisions = 48;
/** How far the plane extends beyond the model, relative to its extent. */
const planeMargin = 0.08;
/** Pieces become longer until there are no more positions, so that a preview answers at once. */
const maxPositions = 60_000;

/** The box around the samples of a model. */
interface Box {
  readonly low: Position;
  readonly high: Position;
}

/** Collects positions with segments and triangles between them. */
class SurfaceBuilder {
  readonly points: number[] = [];
  readonly segments: number[] = [];
  readonly triangles: number[] = [];
  readonly plane: number[] = [];

  add([x, y, z]: Position): number {
    this.points.push(x, y, z);
    return this.points.length / 3 - 1;
  }

  finished(bodies: readonly number[]): SizeSurface {
    return {
      points: Float64Array.from(this.points),
      segments: Uint32Array.from(this.segments),
      triangles: Uint32Array.from(this.triangles),
      plane: Uint32Array.from(this.plane),
      bodies,
    };
  }
}

/**
 * Returns positions along the lines and on the patches of a preview and on prepared bodies, close enough to show how sizes
 * change between them, and on a plane across the model, if one is given. Everything is covered, however large the model is.
 */
export function sizeSurface(
  project: Project,
  preview: ProjectPreview,
  bodies: readonly SizedBody[],
  plane: SizePlane | null,
): SizeSurface {
  const builder = new SurfaceBuilder();
  const box = boxOf(project, preview, bodies);
  const surfaces = [{ points: preview.patchPoints, triangles: preview.patchTriangles }, ...bodies];
  const diagonal = Math.hypot(...box.high.map((x, k) => x - (box.low[k] ?? 0)));
  let longest = pieceShare * diagonal;
  while (longest < diagonal && countPositions(preview, surfaces, longest) > maxPositions) longest *= 2;
  if (plane) addPlane(builder, box, plane);
  addLines(builder, preview, longest);
  for (const surface of surfaces) addTriangles(builder, surface, longest);
  return builder.finished(bodies.map(({ body }) => body));
}

type Triangles = Pick<SizedBody, "points" | "triangles">;

/** Returns how many positions lines and triangles get. */
function countPositions(
  { lineOffsets, linePoints }: ProjectPreview,
  surfaces: readonly Triangles[],
  longest: number,
): number {
  let count = 0;
  for (const i of segmentsOf(lineOffsets)) {
    count += 1 + piecesOf(positionAt(linePoints, i), positionAt(linePoints, i + 1), longest);
  }
  for (const { points, triangles } of surfaces) {
    const isUsed = new Uint8Array(points.length / 3);
    for (let t = 0; t + 2 < triangles.length; t += 3) {
      const pieces = piecesAlong(cornersAt(points, triangles, t), longest);
      if (pieces > 1) count += ((pieces + 1) * (pieces + 2)) / 2;
      else for (const node of triangles.subarray(t, t + 3)) isUsed[node] = 1;
    }
    count += isUsed.reduce((sum, one) => sum + one, 0);
  }
  return count;
}

function boxOf(
  { points, background }: Project,
  { linePoints, patchPoints }: ProjectPreview,
  bodies: readonly SizedBody[],
): Box {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const include = (axis: number, value: number): void => {
    low[axis] = Math.min(low[axis] ?? value, value);
    high[axis] = Math.max(high[axis] ?? value, value);
  };
  for (const list of [linePoints, patchPoints, ...bodies.map((body) => body.points)])
    for (let i = 0; i < list.length; ++i) include(i % 3, list[i] ?? 0);
  const others = points.length > 0 || bodies.length > 0 ? points : background.nodes;
  if (others.length > 0)
    for (const axis of [0, 1, 2]) rangeAlong(others, axis).forEach((x) => include(axis, x));
  const [a = 0, b = 0, c = 0] = low.map((x) => (Number.isFinite(x) ? x : 0));
  const [d = 0, e = 0, f = 0] = high.map((x) => (Number.isFinite(x) ? x : 0));
  return { low: [a, b, c], high: [d, e, f] };
}

function addPlane(builder: SurfaceBuilder, { low, high }: Box, { axis, position }: SizePlane): void {
  const across = { x: 0, y: 1, z: 2 }[axis];
  const [u, v] = [(across + 1) % 3, (across + 2) % 3];
  const at = (k: number, share: number): number => (low[k] ?? 0) + share * ((high[k] ?? 0) - (low[k] ?? 0));
  const wide = (step: number): number => (step / planeDivisions) * (1 + 2 * planeMargin) - planeMargin;
  const row = planeDivisions + 1;
  for (let i = 0; i < row; ++i) {
    for (let j = 0; j < row; ++j) {
      const place: [number, number, number] = [0, 0, 0];
      place[across] = at(across, position);
      place[u] = at(u, wide(i));
      place[v] = at(v, wide(j));
      const corner = builder.add(place);
      if (i < planeDivisions && j < planeDivisions) {
        builder.plane.push(corner, corner + row, corner + row + 1, corner, corner + row + 1, corner + 1);
      }
    }
  }
}

function addLines(
  builder: SurfaceBuilder,
  { lineOffsets, linePoints }: ProjectPreview,
  longest: number,
): void {
  for (const i of segmentsOf(lineOffsets)) {
    const [a, b] = [positionAt(linePoints, i), positionAt(linePoints, i + 1)];
    const pieces = piecesOf(a, b, longest);
    for (let piece = 0; piece <= pieces; ++piece) {
      const index = builder.add(mix(a, b, piece / pieces));
      if (piece > 0) builder.segments.push(index - 1, index);
    }
  }
}

/** Gives the index of the first sample of each segment of each line. */
function* segmentsOf(lineOffsets: Uint32Array): Generator<number> {
  for (let line = 0; line + 1 < lineOffsets.length; ++line) {
    for (let i = lineOffsets[line] ?? 0; i + 1 < (lineOffsets[line + 1] ?? 0); ++i) yield i;
  }
}

/** Divides each triangle evenly, by its longest edge. Triangles that stay whole share their corners. */
function addTriangles(builder: SurfaceBuilder, { points, triangles }: Triangles, longest: number): void {
  const known = new Map<number, number>();
  const shared = (node: number): number => {
    const index = known.get(node) ?? builder.add(positionAt(points, node));
    known.set(node, index);
    return index;
  };
  for (let t = 0; t + 2 < triangles.length; t += 3) {
    const corners = cornersAt(points, triangles, t);
    const pieces = piecesAlong(corners, longest);
    if (pieces > 1) addDivided(builder, corners, pieces);
    else builder.triangles.push(...[...triangles.subarray(t, t + 3)].map(shared));
  }
}

function addDivided(builder: SurfaceBuilder, [a, b, c]: Corners, pieces: number): void {
  let before: readonly number[] = [];
  for (let i = 0; i <= pieces; ++i) {
    const [from, to] = [mix(a, b, i / pieces), mix(a, c, i / pieces)];
    const row = Array.from({ length: i + 1 }, (_, j) => builder.add(i === 0 ? a : mix(from, to, j / i)));
    row.forEach((corner, j) => {
      const [next, above, beside] = [row[j + 1], before[j], before[j + 1]];
      if (next === undefined || above === undefined) return;
      builder.triangles.push(above, corner, next);
      if (beside !== undefined) builder.triangles.push(above, next, beside);
    });
    before = row;
  }
}

type Corners = readonly [Position, Position, Position];

const cornersAt = (points: Float64Array, triangles: Uint32Array, t: number): Corners => [
  positionAt(points, triangles[t] ?? 0),
  positionAt(points, triangles[t + 1] ?? 0),
  positionAt(points, triangles[t + 2] ?? 0),
];

const piecesAlong = ([a, b, c]: Corners, longest: number): number =>
  Math.max(piecesOf(a, b, longest), piecesOf(b, c, longest), piecesOf(c, a, longest));

/** Largest number of pieces of an edge. */
const maxPieces = 64;

function piecesOf(a: Position, b: Position, longest: number): number {
  const length = Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  return Math.min(maxPieces, Math.max(1, Math.ceil(length / longest) || 1));
}

const positionAt = (list: Float64Array, index: number): Position => [
  list[3 * index] ?? 0,
  list[3 * index + 1] ?? 0,
  list[3 * index + 2] ?? 0,
];

const mix = (a: Position, b: Position, share: number): Position => [
  a[0] + share * (b[0] - a[0]),
  a[1] + share * (b[1] - a[1]),
  a[2] + share * (b[2] - a[2]),
];
