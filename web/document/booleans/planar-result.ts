import type { Position } from "../position";
import { ShapeBuilder, type Shape } from "../shape";
import { add, areaVector, cross, distance, dot, scale, subtract, unit } from "../vectors";
import type { Combined } from "./combine";
import type { Solid } from "./solids";

/** Points, straight lines and planar patches from triangles that lie in planar patches. */

/** Sine of the angle between lines and between planes up to which they are parallel. */
const parallelSine = 1e-5;
/** Distance within which three planes replace a rounded node by their exact intersection, relative to the extent. */
const planeTolerance = 1e-5;

/** The plane of a patch: positions p with p · normal = offset. */
interface Plane {
  readonly normal: Position;
  readonly offset: number;
}

/** Triangles of one patch that are connected. */
interface Face {
  readonly plane: Plane;
  readonly name: string | undefined;
  /** Closed chains of nodes, counter-clockwise as seen from outside around the area. */
  readonly loops: readonly (readonly number[])[];
}

/**
 * Returns the boundary of a combination of planar solids as points, lines and planar patches with the names of the solids'
 * patches; null if a patch has no plane. A patch that was cut in two becomes two patches. O(triangles).
 */
export function planarShape(combined: Combined, solids: readonly [Solid, Solid]): Shape | null {
  const faces = facesOf(combined, solids);
  if (!faces) return null;
  const facesAt = new Map<number, Set<number>>();
  faces.forEach(({ loops }, face) => {
    for (const node of loops.flat()) facesAt.set(node, (facesAt.get(node) ?? new Set()).add(face));
  });
  const at = (node: number): Position => positionAt(combined.points, node);
  const builder = new ShapeBuilder();
  const points = new Map<number, number>();
  const pointOf = (node: number): number => {
    let point = points.get(node);
    if (point === undefined) {
      const planes = [...(facesAt.get(node) ?? [])].flatMap((face) => faces[face]?.plane ?? []);
      point = builder.point(sharpened(at(node), planes, extentOf(combined.points)));
      points.set(node, point);
    }
    return point;
  };
  for (const { plane, name, loops } of faces) {
    const polygons = loops
      .map((loop) => cornersOf(loop, faces, facesAt, at))
      .filter((loop) => loop.length >= 3)
      .map((loop) => ({ loop, area: dot(areaVector(loop.map(at)), plane.normal) }))
      // The outer loop has the largest area and is counter-clockwise; holes are clockwise.
      .sort((a, b) => b.area - a.area);
    if (polygons.length === 0) return null;
    builder.patch(
      "planar",
      polygons.map(({ loop }) => builder.polygon(loop.map(pointOf))),
      name,
    );
  }
  return builder.shape;
}

const positionAt = (points: Float64Array, node: number): Position => [
  points[3 * node] ?? 0,
  points[3 * node + 1] ?? 0,
  points[3 * node + 2] ?? 0,
];

function extentOf(points: Float64Array): number {
  let [least, largest] = [Infinity, -Infinity];
  for (const x of points) [least, largest] = [Math.min(least, x), Math.max(largest, x)];
  return largest - least;
}

function facesOf(
  { points, triangles, solid, patch }: Combined,
  solids: readonly [Solid, Solid],
): Face[] | null {
  const key = (triangle: number): string => `${solid[triangle] ?? 0} ${patch[triangle] ?? 0}`;
  const halves = new Map<string, number>();
  const node = (half: number): number => triangles[half] ?? 0;
  const next = (half: number): number => (half % 3 === 2 ? half - 2 : half + 1);
  for (let half = 0; half < triangles.length; ++half) {
    halves.set(`${node(half)} ${node(next(half))}`, half);
  }
  /** The half-edge on the other side, if it belongs to the same patch. */
  const inside = (half: number): number | undefined => {
    const twin = halves.get(`${node(next(half))} ${node(half)}`);
    const isSame = twin !== undefined && key(Math.floor(twin / 3)) === key(Math.floor(half / 3));
    return isSame ? twin : undefined;
  };
  const planes = solids.map(planesOf);
  const visited = new Uint8Array(triangles.length / 3);
  const faces: Face[] = [];
  for (let seed = 0; seed < visited.length; ++seed) {
    if (visited[seed]) continue;
    const component = [seed];
    visited[seed] = 1;
    for (const triangle of component) {
      for (let half = 3 * triangle; half < 3 * triangle + 3; ++half) {
        const twin = inside(half);
        const other = twin === undefined ? -1 : Math.floor(twin / 3);
        if (other < 0 || visited[other]) continue;
        visited[other] = 1;
        component.push(other);
      }
    }
    const which = solid[seed] ?? 0;
    const index = patch[seed] ?? 0;
    const plane = planes[which]?.[index];
    if (!plane) return null;
    // Of the second solid of a difference, the inside is now outside.
    const [a, b, c] = [0, 1, 2].map((corner) => positionAt(points, node(3 * seed + corner)));
    const facing = a && b && c ? dot(cross(subtract(b, a), subtract(c, a)), plane.normal) : 1;
    faces.push({
      plane: facing < 0 ? { normal: scale(plane.normal, -1), offset: -plane.offset } : plane,
      name: solids[which]?.patches[index]?.name,
      loops: loopsOf(component, { node, next, inside }),
    });
  }
  return faces;
}

interface Halves {
  readonly node: (half: number) => number;
  readonly next: (half: number) => number;
  readonly inside: (half: number) => number | undefined;
}

/** Returns the loops around connected triangles. Loops that touch at a node stay apart. */
function loopsOf(component: readonly number[], { node, next, inside }: Halves): number[][] {
  const waiting = new Set<number>();
  for (const triangle of component) {
    for (let half = 3 * triangle; half < 3 * triangle + 3; ++half) {
      if (inside(half) === undefined) waiting.add(half);
    }
  }
  const loops: number[][] = [];
  for (const first of waiting) {
    const loop: number[] = [];
    let half = first;
    do {
      waiting.delete(half);
      loop.push(node(half));
      half = next(half);
      // Turns around the node through the triangles of the patch, to its next edge on the boundary.
      for (let twin = inside(half); twin !== undefined; twin = inside(half)) half = next(twin);
    } while (half !== first && waiting.has(half));
    loops.push(loop);
  }
  return loops;
}

/** Returns the plane of each patch of a solid, by its triangles; undefined without area. */
function planesOf({ points, triangles, trianglePatch, patches }: Solid): (Plane | undefined)[] {
  const sums = patches.map((): Position => [0, 0, 0]);
  const onPatch = patches.map((): Position | undefined => undefined);
  trianglePatch.forEach((index, triangle) => {
    const [a, b, c] = [0, 1, 2].map((corner) => positionAt(points, triangles[3 * triangle + corner] ?? 0));
    if (!a || !b || !c) return;
    sums[index] = add(sums[index] ?? [0, 0, 0], cross(subtract(b, a), subtract(c, a)));
    onPatch[index] ??= a;
  });
  return sums.map((sum, index) => {
    const normal = unit(sum);
    const position = onPatch[index];
    return normal && position ? { normal, offset: dot(normal, position) } : undefined;
  });
}

/** Returns the nodes of a loop without those in the middle of a straight line between the same two faces. */
function cornersOf(
  loop: readonly number[],
  faces: readonly Face[],
  facesAt: ReadonlyMap<number, ReadonlySet<number>>,
  at: (node: number) => Position,
): number[] {
  return loop.filter((node, i) => {
    const around = [...(facesAt.get(node) ?? [])];
    const [one, other] = around.map((face) => faces[face]?.plane.normal);
    if (around.length !== 2 || !one || !other) return true;
    // Between two planes that are not parallel there is only one line.
    if (Math.hypot(...cross(one, other)) > parallelSine) return isTurn(loop, i, at, 1);
    return isTurn(loop, i, at, parallelSine);
  });
}

/** Returns whether a loop turns at a node by an angle whose sine is above a limit, or back. */
function isTurn(loop: readonly number[], i: number, at: (node: number) => Position, limit: number): boolean {
  const [before, here, after] = [loop.at(i - 1), loop[i], loop[(i + 1) % loop.length]].map((node) =>
    at(node ?? 0),
  );
  const [into, out] = [
    unit(subtract(here ?? [0, 0, 0], before ?? [0, 0, 0])),
    unit(subtract(after ?? [0, 0, 0], here ?? [0, 0, 0])),
  ];
  if (!into || !out) return true;
  return dot(into, out) <= 0 || Math.hypot(...cross(into, out)) > limit;
}

/** Returns the position near a rounded one at which three of the planes meet; the rounded one if no three do. */
function sharpened(position: Position, planes: readonly Plane[], extent: number): Position {
  let best: Position | null = null;
  let bestDeterminant = parallelSine;
  for (let i = 0; i < planes.length; ++i) {
    for (let j = i + 1; j < planes.length; ++j) {
      for (let k = j + 1; k < planes.length; ++k) {
        const [p, q, r] = [planes[i], planes[j], planes[k]];
        if (!p || !q || !r) continue;
        const determinant = Math.abs(dot(p.normal, cross(q.normal, r.normal)));
        if (determinant <= bestDeterminant) continue;
        const found = meetingOf(p, q, r);
        if (distance(found, position) > planeTolerance * extent) continue;
        [best, bestDeterminant] = [found, determinant];
      }
    }
  }
  return best ?? position;
}

/** Returns where three planes meet (Cramer). */
function meetingOf(p: Plane, q: Plane, r: Plane): Position {
  const qr = cross(q.normal, r.normal);
  const sum = add(
    add(scale(qr, p.offset), scale(cross(r.normal, p.normal), q.offset)),
    scale(cross(p.normal, q.normal), r.offset),
  );
  return scale(sum, 1 / dot(p.normal, qr));
}
