import type { LinePath } from "./line-paths";
import type { DrawnLoop } from "./drawn-loop";
import type { Position } from "./position";
import {
  cross,
  dot,
  frameAlong,
  length,
  subtract,
  toFrame,
  unit,
  fromFrame,
  type Frame,
  boxOf,
  distance,
} from "./vectors";

/** Lines lie in a plane if their distance from it is at most this, relative to the extent of the model. */
const planarity = 1e-7;

/** Position in a plane. */
export type Flat = readonly [x: number, y: number];

/** A line traversed in one direction, in coordinates of the plane. */
interface HalfEdge {
  readonly path: LinePath;
  readonly from: number;
  readonly to: number;
  /** 1 in the direction of the line, -1 against it. */
  readonly sign: 1 | -1;
  readonly points: readonly Flat[];
  /** Direction at its start, in radians. */
  readonly angle: number;
  twin: HalfEdge;
  next: HalfEdge;
}

/** A closed sequence of half-edges and twice its signed area: positive if it is counter-clockwise. */
interface Face {
  readonly edges: readonly HalfEdge[];
  readonly polygon: readonly Flat[];
  readonly area: number;
}

/** Returns the smallest loops of lines in each plane that contains lines, with the loops inside them as holes. */
export function planarLoops(paths: readonly LinePath[]): DrawnLoop[] {
  const extent = extentOf(paths);
  return planesOf(paths, extent).flatMap((frame) =>
    loopsIn(frame, inPlane(paths, frame, planarity * extent)),
  );
}

function extentOf(paths: readonly LinePath[]): number {
  const { low, high } = boxOf(paths.flatMap(({ positions }) => positions.flat()));
  return distance(low, high) || 1;
}

/** Returns the planes of every two lines that share an end, and of every curved line; each plane once. */
function planesOf(paths: readonly LinePath[], extent: number): Frame[] {
  const planes = new Map<string, Frame>();
  const add = (positions: readonly Position[]): void => {
    const normal = normalOf(positions);
    const [through] = positions;
    if (!normal || !through) return;
    const offset = dot(normal, through);
    if (positions.some((position) => Math.abs(dot(normal, position) - offset) > planarity * extent)) return;
    const signed = normal.find((x) => Math.abs(x) > 1e-9) ?? 1;
    const sign = signed < 0 ? -1 : 1;
    // Planes at the border of two keys are found twice, which only costs time: equal loops are dropped later.
    const key = [...normal.map((x) => x * sign), (offset * sign) / extent]
      .map((x) => Math.round(x * 1e6) + 0)
      .join();
    if (!planes.has(key)) planes.set(key, frameAlong(normal, through));
  };
  const atPoint = new Map<number, Position[][]>();
  for (const { line, positions } of paths) {
    add(positions);
    const ends = [
      [line.points.at(0), positions],
      [line.points.at(-1), positions.toReversed()],
    ] as const;
    for (const [point, from] of ends) {
      if (point === undefined) continue;
      const others = atPoint.get(point) ?? [];
      for (const other of others) add([...other.toReversed(), ...from.slice(1)]);
      atPoint.set(point, [...others, [...from]]);
    }
  }
  return [...planes.values()];
}

/** Returns the unit normal of the plane of positions; null if they lie on one line. */
function normalOf(positions: readonly Position[]): Position | null {
  const [first] = positions;
  if (!first) return null;
  const arms = positions.map((position) => subtract(position, first));
  const longest = arms.reduce(
    (best, arm) => (dot(arm, arm) > dot(best, best) ? arm : best),
    arms[0] ?? first,
  );
  const normals = arms.map((arm) => cross(longest, arm));
  const normal = normals.reduce((best, next) => (dot(next, next) > dot(best, best) ? next : best), [0, 0, 0]);
  return length(normal) > 1e-9 * dot(longest, longest) ? unit(normal) : null;
}

/** Returns the lines that lie in a plane, in its coordinates. */
function inPlane(paths: readonly LinePath[], frame: Frame, tolerance: number) {
  const offset = dot(frame.origin, frame.z);
  return paths.flatMap((path) => {
    const lies = path.positions.every((position) => Math.abs(dot(position, frame.z) - offset) <= tolerance);
    if (!lies || path.positions.length < 2) return [];
    return [
      {
        path,
        points: path.positions.map((position): Flat => {
          const [x, y] = toFrame(frame, position);
          return [x, y];
        }),
      },
    ];
  });
}

type FlatPath = ReturnType<typeof inPlane>[number];

function loopsIn(frame: Frame, paths: readonly FlatPath[]): DrawnLoop[] {
  const toSpace = ([x, y]: Flat): Position => fromFrame(frame, [x, y, 0]);
  const idsOf = ({ edges }: Face): number[] => edges.map(({ path }) => path.line.id);
  return facesWithHoles(paths).map(({ face, holes }) => ({
    lines: idsOf(face),
    holes: holes.map(idsOf),
    polygon: face.polygon.map(toSpace),
    holePolygons: holes.map(({ polygon }) => polygon.map(toSpace)),
    normal: frame.z,
  }));
}

/** A smallest area of a plane that lines enclose. */
export interface PlaneFace {
  /** Signed ids of the lines: counter-clockwise around the area, then clockwise around each hole. */
  readonly loops: readonly (readonly number[])[];
  /** Positions around each loop; the first one is not repeated. */
  readonly polygons: readonly (readonly Flat[])[];
  readonly area: number;
  /** Whether a loop passes a point twice. */
  readonly isPinched: boolean;
}

/** Returns the smallest areas that the lines in the plane of a frame enclose. */
export function facesInPlane(
  paths: readonly LinePath[],
  frame: Frame,
  tolerance: number,
): readonly PlaneFace[] {
  return facesWithHoles(inPlane(paths, frame, tolerance)).map(({ face, holes }) => {
    const all = [face, ...holes];
    return {
      loops: all.map(({ edges }) => edges.map(({ path, sign }) => sign * path.line.id)),
      polygons: all.map(({ polygon }) => polygon),
      area: all.reduce((sum, { area }) => sum + area, 0) / 2,
      isPinched: all.some(({ edges }) => new Set(edges.map(({ from }) => from)).size < edges.length),
    };
  });
}

function facesWithHoles(paths: readonly FlatPath[]) {
  const faces = facesOf(withoutBridges(withoutDangling(paths)));
  const inner = faces.filter(({ area }) => area > 0);
  const outlines = faces.filter(({ area }) => area < 0);
  return inner.map((face) => {
    const points = new Set(face.edges.map(({ from }) => from));
    const holes = outlines.filter(
      (outline) =>
        outline.edges.every(({ from }) => !points.has(from)) &&
        -outline.area < face.area &&
        isSmallestAround(outline, face, inner),
    );
    return { face, holes };
  });
}

/** Returns whether no face inside `face` also contains the outline. */
function isSmallestAround(outline: Face, face: Face, faces: readonly Face[]): boolean {
  const [corner] = outline.polygon;
  if (!corner || !isInside(corner, face.polygon)) return false;
  const own = new Set(outline.edges.map(({ from }) => from));
  return !faces.some(
    (other) =>
      other !== face &&
      other.area < face.area &&
      other.edges.every(({ from }) => !own.has(from)) &&
      isInside(corner, other.polygon),
  );
}

/** Removes lines with an end that no other line has, again and again. */
function withoutDangling(paths: readonly FlatPath[]): readonly FlatPath[] {
  const degrees = new Map<number, number>();
  const endsOf = ({ path: { line } }: FlatPath): number[] => [
    line.points.at(0) ?? 0,
    line.points.at(-1) ?? 0,
  ];
  for (const end of paths.flatMap(endsOf)) degrees.set(end, (degrees.get(end) ?? 0) + 1);
  const kept = paths.filter((path) => endsOf(path).every((end) => (degrees.get(end) ?? 0) > 1));
  return kept.length === paths.length ? paths : withoutDangling(kept);
}

/** Removes lines that have the same face on both sides: they join loops without bounding one. */
function withoutBridges(paths: readonly FlatPath[]): readonly FlatPath[] {
  const bridges = new Set(
    facesOf(paths).flatMap(({ edges }) => {
      const seen = new Set<LinePath>();
      return edges.flatMap(({ path }) => (seen.has(path) ? [path] : (seen.add(path), [])));
    }),
  );
  if (bridges.size === 0) return paths;
  return withoutDangling(paths.filter(({ path }) => !bridges.has(path)));
}

/** Returns the faces of a plane graph: each half-edge belongs to one. */
function facesOf(paths: readonly FlatPath[]): Face[] {
  const edges = halfEdges(paths);
  const seen = new Set<HalfEdge>();
  const faces: Face[] = [];
  for (const start of edges) {
    if (seen.has(start)) continue;
    const chain: HalfEdge[] = [];
    for (let edge = start; !seen.has(edge); edge = edge.next) {
      seen.add(edge);
      chain.push(edge);
    }
    const polygon = chain.flatMap(({ points }) => points.slice(0, -1));
    faces.push({ edges: chain, polygon, area: doubleArea(polygon) });
  }
  return faces;
}

/** Returns both directions of every line. `next` turns as far to the left as possible, so faces are the smallest. */
function halfEdges(paths: readonly FlatPath[]): HalfEdge[] {
  const edges = paths.flatMap(({ path, points }) => {
    const [from, to] = [path.line.points.at(0) ?? 0, path.line.points.at(-1) ?? 0];
    const forward = directed(path, 1, [from, to], points);
    const backward = directed(path, -1, [to, from], points.toReversed());
    forward.twin = backward;
    backward.twin = forward;
    return [forward, backward];
  });
  const around = new Map<number, HalfEdge[]>();
  for (const edge of edges) around.set(edge.from, [...(around.get(edge.from) ?? []), edge]);
  for (const list of around.values()) {
    list.sort((a, b) => a.angle - b.angle);
    // From the reversed edge, the next one clockwise continues the face on the left.
    list.forEach((edge, i) => (edge.twin.next = list[(i + list.length - 1) % list.length] ?? edge));
  }
  return edges;
}

function directed(
  path: LinePath,
  sign: 1 | -1,
  [from, to]: readonly [number, number],
  points: readonly Flat[],
): HalfEdge {
  const [start = [0, 0], ...rest] = points;
  const ahead = rest.find(([x, y]) => x !== start[0] || y !== start[1]) ?? start;
  const angle = Math.atan2(ahead[1] - start[1], ahead[0] - start[0]);
  const edge = { path, sign, from, to, points, angle } as HalfEdge;
  edge.next = edge;
  return edge;
}

function doubleArea(polygon: readonly Flat[]): number {
  return polygon.reduce((sum, [x, y], i) => {
    const [nextX, nextY] = polygon[(i + 1) % polygon.length] ?? [x, y];
    return sum + x * nextY - y * nextX;
  }, 0);
}

/** Returns whether a position lies inside a polygon, by the crossings of a half-line. */
export function isInside([x, y]: Flat, polygon: readonly Flat[]): boolean {
  let inside = false;
  polygon.forEach(([ax, ay], i) => {
    const [bx, by] = polygon[(i + 1) % polygon.length] ?? [ax, ay];
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  });
  return inside;
}
