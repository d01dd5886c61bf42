import type { Position } from "../document/position";
import type { ProjectedPoint, Screen } from "./screen";

/** How near the pointer must be to a dot or a line, in CSS pixels. */
export const dotReach = 9;
export const lineReach = 6;

/** A dot or segment near the pointer. */
export interface Nearest {
  readonly index: number;
  /** Share of the segment before the point nearest to the pointer, 0 to 1; 0 for a dot. */
  readonly along: number;
  readonly depth: number;
}

const blank = (): ProjectedPoint => ({ x: 0, y: 0, depth: 0 });

/**
 * Returns the dot nearest to the pointer, or null if none lies within reach and no deeper than the screen's limit.
 * @param positions x y z per dot, local.
 */
export function nearestDot(
  positions: ArrayLike<number>,
  screen: Screen,
  isDrawn: (index: number) => boolean,
): Nearest | null {
  const { pointer, maxDepth } = screen;
  const point = blank();
  let nearest: Nearest | null = null;
  let reach = dotReach;
  for (let i = 0; 3 * i < positions.length; ++i) {
    const [x = 0, y = 0, z = 0] = [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
    if (!screen.project(x, y, z, point) || point.depth > maxDepth) continue;
    const distance = Math.hypot(point.x - pointer.x, point.y - pointer.y);
    if (distance >= reach || !isDrawn(i)) continue;
    nearest = { index: i, along: 0, depth: point.depth };
    reach = distance;
  }
  return nearest;
}

/**
 * Returns the segment nearest to the pointer, or null if none lies within reach and no deeper than the limit.
 * @param segments x y z of both ends per segment, local.
 */
export function nearestSegment(
  segments: ArrayLike<number>,
  screen: Screen,
  isDrawn: (index: number) => boolean,
  maxDepth = screen.maxDepth,
): Nearest | null {
  const { pointer } = screen;
  const [a, b] = [blank(), blank()];
  let nearest: Nearest | null = null;
  let reach = lineReach;
  const project = (at: number, point: ProjectedPoint): boolean =>
    screen.project(segments[at] ?? 0, segments[at + 1] ?? 0, segments[at + 2] ?? 0, point);
  for (let i = 0; 6 * i < segments.length; ++i) {
    if (!project(6 * i, a) || !project(6 * i + 3, b)) continue;
    if (Math.min(a.depth, b.depth) > maxDepth) continue;
    const [dx, dy] = [b.x - a.x, b.y - a.y];
    const squared = dx * dx + dy * dy;
    const share = squared === 0 ? 0 : ((pointer.x - a.x) * dx + (pointer.y - a.y) * dy) / squared;
    const along = Math.min(1, Math.max(0, share));
    const distance = Math.hypot(a.x + along * dx - pointer.x, a.y + along * dy - pointer.y);
    if (distance >= reach || !isDrawn(i)) continue;
    nearest = { index: i, along, depth: a.depth + along * (b.depth - a.depth) };
    reach = distance;
  }
  return nearest;
}

/** Returns the position that `along` gives on a segment. */
export function pointOnSegment(segments: ArrayLike<number>, { index, along }: Nearest): Position {
  const coordinate = (axis: number): number => {
    const from = segments[6 * index + axis] ?? 0;
    return from + along * ((segments[6 * index + 3 + axis] ?? 0) - from);
  };
  return [coordinate(0), coordinate(1), coordinate(2)];
}
