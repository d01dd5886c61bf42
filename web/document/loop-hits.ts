import type { Project } from "tetrafront/project";
import type { DrawnLoop } from "./drawn-loop";
import { fanOf, keyOf } from "./loop-search";
import { isInside, type Flat } from "./planar-loops";
import type { Position } from "./position";
import { addScaled, cross, dot, frameAlong, subtract, toFrame } from "./vectors";
import { onPlane, type Ray } from "./work-plane";

/** Returns the first of the loops that a ray passes through; null if it misses all. O(positions). */
export function firstLoop(loops: readonly DrawnLoop[], ray: Ray): DrawnLoop | null {
  let found: DrawnLoop | null = null;
  let nearest = Infinity;
  for (const loop of loops) {
    const depth = depthOf(loop, ray);
    if (depth === null || depth >= nearest) continue;
    nearest = depth;
    found = loop;
  }
  return found;
}

/** Returns the distance along a ray at which it passes through a loop; null if it misses the loop. */
function depthOf({ polygon, holePolygons, normal }: DrawnLoop, ray: Ray): number | null {
  const [first] = polygon;
  if (!first) return null;
  if (!normal) return fanDepth(fanOf(polygon), ray);
  const frame = frameAlong(normal, first);
  const position = onPlane(ray, frame);
  if (!position) return null;
  const flat = (at: Position): Flat => {
    const [x, y] = toFrame(frame, at);
    return [x, y];
  };
  const at = flat(position);
  const isHit = isInside(at, polygon.map(flat)) && !holePolygons.some((hole) => isInside(at, hole.map(flat)));
  return isHit ? dot(subtract(position, ray.origin), ray.direction) : null;
}

/** Returns the distance along a ray to the nearest of some triangles, given by three corners each. */
function fanDepth(corners: readonly Position[], { origin, direction }: Ray): number | null {
  let nearest: number | null = null;
  for (let i = 0; i + 2 < corners.length; i += 3) {
    const [a, b, c] = [corners[i], corners[i + 1], corners[i + 2]];
    if (!a || !b || !c) continue;
    const [u, v] = [subtract(b, a), subtract(c, a)];
    const normal = cross(u, v);
    const slope = dot(normal, direction);
    if (slope === 0) continue;
    const depth = dot(normal, subtract(a, origin)) / slope;
    const offset = subtract(addScaled(origin, direction, depth), a);
    const square = dot(normal, normal);
    const [s, t] = [dot(cross(offset, v), normal) / square, dot(cross(u, offset), normal) / square];
    if (depth > 0 && s >= 0 && t >= 0 && s + t <= 1) nearest = Math.min(nearest ?? depth, depth);
  }
  return nearest;
}

/** What a click into a loop does. */
export type LoopUse =
  | { readonly kind: "patch"; readonly loop: DrawnLoop }
  /** The loop becomes a hole of a planar patch that covers it. */
  | { readonly kind: "hole"; readonly loop: DrawnLoop; readonly patch: number };

/** Returns the uses of loops that no patch fills yet. A loop inside a planar patch becomes a hole of it first. */
export function freeLoops(project: Project, loops: readonly DrawnLoop[]): readonly LoopUse[] {
  const filled = new Set(project.patches.map(({ loops: [outer = []] }) => keyOf(outer)));
  const holes = new Set(project.patches.flatMap(({ loops: [, ...inner] }) => inner.map(keyOf)));
  const byKey = new Map(loops.map((loop) => [keyOf(loop.lines), loop]));
  const patches = project.patches.flatMap(({ id, type, loops: [outer = []] }) => {
    const loop = type === "planar" ? byKey.get(keyOf(outer)) : undefined;
    return loop ? [{ id, loop }] : [];
  });
  return loops.flatMap((loop): LoopUse[] => {
    const key = keyOf(loop.lines);
    if (filled.has(key)) return [];
    // The drawn loop of the covering patch lists this one among the loops inside it.
    const cover = patches.find((patch) => patch.loop.holes.some((hole) => keyOf(hole) === key));
    return cover && !holes.has(key) ? [{ kind: "hole", loop, patch: cover.id }] : [{ kind: "patch", loop }];
  });
}
