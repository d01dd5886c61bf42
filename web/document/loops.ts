import type { Project, ProjectLine } from "tetrafront/project";
import { findRecord } from "./entities";
import { loopDefects, selectionHints } from "../strings";
import { rangeAlong } from "./extent";
import { areaVector, dot, zero } from "./vectors";
import type { Position } from "./position";

/** Closed chains of lines, the outer one first; a negative id traverses its line backwards. */
export type LoopSearch =
  | { readonly success: true; readonly loops: readonly (readonly number[])[] }
  | { readonly success: false; readonly reason: string };

const endsOf = ({ points }: ProjectLine): readonly [number, number] => [points[0] ?? 0, points.at(-1) ?? 0];

/** Finds an end point that does not belong to exactly two of the lines, and returns why; null if there is none. */
function findLooseEnd(lines: readonly ProjectLine[]): string | null {
  const meetings = new Map<number, number>();
  for (const line of lines) {
    for (const end of endsOf(line)) meetings.set(end, (meetings.get(end) ?? 0) + 1);
  }
  for (const [point, count] of meetings) {
    if (count === 1) return loopDefects.open(point);
    if (count > 2) return loopDefects.branching(point, count);
  }
  return null;
}

/**
 * Removes one loop from `left` and returns it. It begins with the first line of `left`, traversed forwards.
 */
function walkLoop(left: Map<number, ProjectLine>): number[] {
  const [first] = left.values();
  if (!first) return [];
  const [start, firstEnd] = endsOf(first);
  const loop = [first.id];
  left.delete(first.id);
  for (let at = firstEnd; at !== start;) {
    const next = [...left.values()].find((line) => endsOf(line).includes(at));
    if (!next) break;
    const [from, to] = endsOf(next);
    left.delete(next.id);
    loop.push(from === at ? next.id : -next.id);
    at = from === at ? to : from;
  }
  return loop;
}

/**
 * Two closed lines and a line between them bound a tube with a seam, which the loop traverses in both
 * directions. The loop traverses the second closed line opposite to the first; otherwise the tube would
 * intersect itself.
 */
function seamedLoop(project: Project, lines: readonly ProjectLine[]): number[] | null {
  const isClosed = (line: ProjectLine) => endsOf(line)[0] === endsOf(line)[1];
  const [first, second] = lines.filter(isClosed);
  const [seam] = lines.filter((line) => !isClosed(line));
  if (lines.length !== 3 || !first || !second || !seam) return null;
  const [from, to] = [endsOf(first)[0], endsOf(second)[0]];
  const [start, end] = endsOf(seam);
  const there = start === from && end === to ? 1 : start === to && end === from ? -1 : 0;
  if (there === 0) return null;
  const areaOf = ({ points }: ProjectLine): Position =>
    areaVector(points.map((id) => findRecord(project, "point", id)?.position ?? zero));
  const alike = dot(areaOf(first), areaOf(second)) > 0;
  return [first.id, there * seam.id, alike ? -second.id : second.id, -there * seam.id];
}

/** Squared diagonal of the box around all points of a loop's lines. */
function extentOf(project: Project, loop: readonly number[]): number {
  const ids = new Set(loop.flatMap((step) => findRecord(project, "line", Math.abs(step))?.points ?? []));
  const points = project.points.filter(({ id }) => ids.has(id));
  return [0, 1, 2].reduce((sum, axis) => {
    const [low, high] = rangeAlong(points, axis);
    return sum + (high - low) ** 2;
  }, 0);
}

/**
 * Arranges lines, given in any order and direction, into closed loops. Each loop begins with the line given
 * first. The loop with the largest bounding box is the outer one. The two rims of a tube and the line between
 * them form one loop. Quadratic in the number of lines.
 */
export function orderLoops(project: Project, lineIds: readonly number[]): LoopSearch {
  const lines = lineIds.map((id) => findRecord(project, "line", id)).filter((line) => line !== undefined);
  if (lines.length === 0) return { success: false, reason: selectionHints.loop };
  const seamed = seamedLoop(project, lines);
  if (seamed !== null) return { success: true, loops: [seamed] };
  const reason = findLooseEnd(lines);
  if (reason !== null) return { success: false, reason };
  const left = new Map(lines.map((line) => [line.id, line]));
  const loops: number[][] = [];
  while (left.size > 0) loops.push(walkLoop(left));
  const extents = loops.map((loop) => extentOf(project, loop));
  const outer = extents.indexOf(Math.max(...extents));
  const [first] = loops.splice(outer, 1);
  return { success: true, loops: first ? [first, ...loops] : loops };
}

/** Rotates a loop so that the line at an index becomes the second one: F2 of equation (14). */
export function rotateToSecond(loop: readonly number[], index: number): number[] {
  const first = (index + loop.length - 1) % loop.length;
  return [...loop.slice(first), ...loop.slice(0, first)];
}
