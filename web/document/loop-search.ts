import type { LinePath } from "./line-paths";
import type { DrawnLoop } from "./drawn-loop";
import { planarLoops } from "./planar-loops";
import type { Position } from "./position";
import { mean } from "./vectors";

/**
 * Returns the loops of lines that patches can fill: the smallest loops in each plane that contains lines, and loops of three
 * or four lines that lie in no plane.
 */
export function drawnLoops(paths: readonly LinePath[]): readonly DrawnLoop[] {
  const planar = planarLoops(paths);
  const known = new Set(planar.map(({ lines }) => keyOf(lines)));
  return [...planar, ...spatialLoops(paths).filter(({ lines }) => !known.has(keyOf(lines)))];
}

/** Identifies the lines of a loop, in any order. */
export const keyOf = (lines: readonly number[]): string =>
  lines
    .map(Math.abs)
    .toSorted((a, b) => a - b)
    .join();

/** Largest number of lines at a point that is searched for spatial loops: more are no edges of a shape. */
const maxDegree = 24;

/** A line from a point to another. */
interface Arm {
  readonly path: LinePath;
  readonly to: number;
}

/** Returns the loops of three and four lines that pass no point twice and whose corners are not joined by another line. */
function spatialLoops(paths: readonly LinePath[]): DrawnLoop[] {
  const arms = armsOf(paths);
  const isJoined = (a: number, b: number): boolean => (arms.get(a) ?? []).some(({ to }) => to === b);
  const loops = new Map<string, DrawnLoop>();
  const add = (chain: readonly Arm[]): void => {
    const lines = chain.map(({ path }) => path.line.id);
    const polygon = chain.flatMap(({ path, to }) =>
      (path.line.points.at(-1) === to ? path.positions : path.positions.toReversed()).slice(0, -1),
    );
    loops.set(keyOf(lines), { lines, holes: [], polygon, holePolygons: [], normal: null });
  };
  for (const [start, first] of arms) {
    for (const a of first) {
      for (const b of arms.get(a.to) ?? []) {
        if (b.to === start || b.path === a.path) continue;
        for (const c of arms.get(b.to) ?? []) {
          if (c.to === a.to || c.path === b.path) continue;
          if (c.to === start) {
            if (isFirst(start, a.to, b.to)) add([a, b, c]);
            continue;
          }
          if (!isFirst(start, a.to, b.to, c.to) || isJoined(start, b.to) || isJoined(a.to, c.to)) continue;
          for (const d of arms.get(c.to) ?? []) if (d.to === start) add([a, b, c, d]);
        }
      }
    }
  }
  return [...loops.values()];
}

/** Each loop is found from its lowest point, in one direction. */
const isFirst = (start: number, second: number, ...others: readonly number[]): boolean =>
  start < second && others.every((point) => start < point) && second < (others.at(-1) ?? 0);

function armsOf(paths: readonly LinePath[]): ReadonlyMap<number, readonly Arm[]> {
  const arms = new Map<number, Arm[]>();
  const add = (from: number, arm: Arm): void => void (arms.get(from)?.push(arm) ?? arms.set(from, [arm]));
  for (const path of paths) {
    const [from, to] = [path.line.points.at(0), path.line.points.at(-1)];
    if (from === undefined || to === undefined || from === to) continue;
    add(from, { path, to });
    add(to, { path, to: from });
  }
  for (const [point, list] of arms) if (list.length > maxDegree) arms.delete(point);
  return arms;
}

/** Returns three corners per triangle that show a loop which lies in no plane: a fan around its middle. */
export function fanOf(polygon: readonly Position[]): readonly Position[] {
  const middle = mean(polygon);
  return polygon.flatMap((corner, i) => [middle, corner, polygon[(i + 1) % polygon.length] ?? corner]);
}
