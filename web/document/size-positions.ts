import type { PreparedBody } from "tetrafront";
import type { Project, ProjectPreview } from "tetrafront/project";
import { rangeAlong } from "./extent";
import type { Position } from "./position";
import type { SizePlane } from "./selection";
import { forEachInSlices } from "./slices";
import { type Box, type Facts, factsOf, piecesOf } from "./triangle-facts";

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
/**
 * Pieces become longer until there are no more positions, so that the engine answers at once. Only lines and triangles
 * without divisions may have more.
 */
const maxPositions = 60_000;

/** Numbers of positions, segments and triangles without those of the plane. */
interface Counts {
  readonly positions: number;
  readonly segments: number;
  readonly triangles: number;
}

/** Takes as many positions, segments and triangles as were counted. */
class SurfaceBuilder {
  readonly #points: Float64Array;
  readonly #segments: Uint32Array;
  readonly #triangles: Uint32Array;
  readonly plane: number[] = [];
  #pointCount = 0;
  #segmentCount = 0;
  #triangleCount = 0;

  constructor({ positions, segments, triangles }: Counts) {
    this.#points = new Float64Array(3 * positions);
    this.#segments = new Uint32Array(2 * segments);
    this.#triangles = new Uint32Array(3 * triangles);
  }

  add(x: number, y: number, z: number): number {
    const at = 3 * this.#pointCount;
    this.#points[at] = x;
    this.#points[at + 1] = y;
    this.#points[at + 2] = z;
    return this.#pointCount++;
  }

  addSegment(a: number, b: number): void {
    const at = 2 * this.#segmentCount++;
    this.#segments[at] = a;
    this.#segments[at + 1] = b;
  }

  addTriangle(a: number, b: number, c: number): void {
    const at = 3 * this.#triangleCount++;
    this.#triangles[at] = a;
    this.#triangles[at + 1] = b;
    this.#triangles[at + 2] = c;
  }

  finished(bodies: readonly number[]): SizeSurface {
    return {
      points: this.#points,
      segments: this.#segments,
      triangles: this.#triangles,
      plane: Uint32Array.from(this.plane),
      bodies,
    };
  }
}

/**
 * Returns positions along the lines and on the patches of a preview and on prepared bodies, close enough to show how sizes
 * change between them, and on a plane across the model, if one is given. Everything is covered, however large the model is.
 * Works in slices: a body of millions of triangles does not block the page. What it measures of a body, it keeps. Rejects
 * if it is aborted.
 */
export async function sizeSurface(
  project: Project,
  preview: ProjectPreview,
  bodies: readonly SizedBody[],
  plane: SizePlane | null,
  signal?: AbortSignal,
): Promise<SizeSurface> {
  const surfaces: Facts[] = [];
  for (const one of [{ points: preview.patchPoints, triangles: preview.patchTriangles }, ...bodies]) {
    surfaces.push(await factsOf(one));
    signal?.throwIfAborted();
  }
  const box = boxOf(project, preview, surfaces);
  const { counts, longest } = await choosePieces(preview, surfaces, diagonalOf(box), signal);
  const planePositions = plane ? (planeDivisions + 1) ** 2 : 0;
  const builder = new SurfaceBuilder({ ...counts, positions: counts.positions + planePositions });
  if (plane) addPlane(builder, box, plane);
  addLines(builder, preview, longest);
  for (const surface of surfaces) await addTriangles(builder, surface, longest, signal);
  return builder.finished(bodies.map(({ body }) => body));
}

const diagonalOf = ({ low, high }: Box): number => Math.hypot(...high.map((x, k) => x - (low[k] ?? 0)));

/** Returns the length of pieces that gives few enough positions, or divides nothing, and what it gives. */
async function choosePieces(
  preview: ProjectPreview,
  surfaces: readonly Facts[],
  diagonal: number,
  signal?: AbortSignal,
): Promise<{ readonly longest: number; readonly counts: Counts }> {
  // Divided or not, triangles have at least their nodes: if these are too many, only whole ones remain.
  const nodes = surfaces.reduce((sum, { usedNodes }) => sum + usedNodes, 0);
  let longest = nodes > maxPositions ? diagonal : pieceShare * diagonal;
  for (;;) {
    const counts = await count(preview, surfaces, longest, signal);
    if (counts.positions <= maxPositions || longest >= diagonal) return { longest, counts };
    longest *= 2;
  }
}

async function count(
  { lineOffsets, linePoints }: ProjectPreview,
  surfaces: readonly Facts[],
  longest: number,
  signal?: AbortSignal,
): Promise<Counts> {
  let [positions, segments, triangles] = [0, 0, 0];
  for (const i of segmentsOf(lineOffsets)) {
    const pieces = piecesOf(distance(positionAt(linePoints, i), positionAt(linePoints, i + 1)), longest);
    positions += pieces + 1;
    segments += pieces;
  }
  for (const { surface, longestEdges, longestOfAll, usedNodes } of surfaces) {
    if (piecesOf(longestOfAll, longest) === 1) {
      positions += usedNodes;
      triangles += longestEdges.length;
      continue;
    }
    const isUsed = new Uint8Array(surface.points.length / 3);
    await forEachInSlices(
      longestEdges.length,
      (t) => {
        const pieces = piecesOf(longestEdges[t] ?? 0, longest);
        triangles += pieces * pieces;
        if (pieces > 1) positions += ((pieces + 1) * (pieces + 2)) / 2;
        for (let k = 3 * t; pieces === 1 && k < 3 * t + 3; ++k) {
          const node = surface.triangles[k] ?? 0;
          positions += 1 - (isUsed[node] ?? 1);
          isUsed[node] = 1;
        }
      },
      signal,
    );
  }
  return { positions, segments, triangles };
}

function boxOf(
  { points, background }: Project,
  { linePoints }: ProjectPreview,
  surfaces: readonly Facts[],
): Box {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const include = (axis: number, value: number): void => {
    low[axis] = Math.min(low[axis] ?? value, value);
    high[axis] = Math.max(high[axis] ?? value, value);
  };
  for (let i = 0; i < linePoints.length; ++i) include(i % 3, linePoints[i] ?? 0);
  for (const { box } of surfaces)
    for (const end of [box?.low, box?.high]) end?.forEach((x, axis) => include(axis, x));
  const hasBodies = surfaces.length > 1;
  const others = points.length > 0 || hasBodies ? points : background.nodes;
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
      const corner = builder.add(...place);
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
    const pieces = piecesOf(distance(a, b), longest);
    for (let piece = 0; piece <= pieces; ++piece) {
      const index = builder.add(...mix(a, b, piece / pieces));
      if (piece > 0) builder.addSegment(index - 1, index);
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
async function addTriangles(
  builder: SurfaceBuilder,
  { surface: { points, triangles }, longestEdges }: Facts,
  longest: number,
  signal?: AbortSignal,
): Promise<void> {
  /** Index + 1 of the position of each node; 0 if it has none yet. */
  const known = new Uint32Array(points.length / 3);
  const shared = (node: number): number => {
    const after = known[node] ?? 0;
    if (after > 0) return after - 1;
    const index = builder.add(points[3 * node] ?? 0, points[3 * node + 1] ?? 0, points[3 * node + 2] ?? 0);
    known[node] = index + 1;
    return index;
  };
  await forEachInSlices(
    longestEdges.length,
    (t) => {
      const [a, b, c] = [triangles[3 * t] ?? 0, triangles[3 * t + 1] ?? 0, triangles[3 * t + 2] ?? 0];
      const pieces = piecesOf(longestEdges[t] ?? 0, longest);
      if (pieces === 1) builder.addTriangle(shared(a), shared(b), shared(c));
      else addDivided(builder, [positionAt(points, a), positionAt(points, b), positionAt(points, c)], pieces);
    },
    signal,
  );
}

type Corners = readonly [Position, Position, Position];

function addDivided(builder: SurfaceBuilder, [a, b, c]: Corners, pieces: number): void {
  let before: readonly number[] = [];
  for (let i = 0; i <= pieces; ++i) {
    const [from, to] = [mix(a, b, i / pieces), mix(a, c, i / pieces)];
    const row = Array.from({ length: i + 1 }, (_, j) => builder.add(...(i === 0 ? a : mix(from, to, j / i))));
    row.forEach((corner, j) => {
      const [next, above, beside] = [row[j + 1], before[j], before[j + 1]];
      if (next === undefined || above === undefined) return;
      builder.addTriangle(above, corner, next);
      if (beside !== undefined) builder.addTriangle(above, next, beside);
    });
    before = row;
  }
}

const distance = (a: Position, b: Position): number => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

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
