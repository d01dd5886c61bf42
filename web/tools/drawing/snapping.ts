import type { LinePath } from "../../document/line-paths";
import type { Position } from "../../document/position";
import { between, cross, distance, dot, length, subtract } from "../../document/vectors";
import type { Ray } from "../../document/work-plane";
import type { PointerView } from "../../viewer/pointer-view";
import type { ScreenPoint } from "../../viewer/screen";

/**
 * What the pointer snaps to. "plane" is a place in the work plane beside its grid. The last two are not under the pointer: typed
 * coordinates, and a place on the circle or arc of a typed radius.
 */
export type SnapKind =
  | "point"
  | "node"
  | "intersection"
  | "middle"
  | "line"
  | "patch"
  | "grid"
  | "plane"
  | "typed"
  | "radius";

export interface Snap {
  readonly kind: SnapKind;
  readonly position: Position;
  /** Id of the point, line or patch; null for other kinds. */
  readonly id: number | null;
  /** Ids of the lines on which the place lies, if it was found there. */
  readonly lines?: readonly number[];
}

/** How near the pointer must be, in CSS pixels. */
const reaches = { point: 12, intersection: 11, middle: 10, line: 7 } as const;
/** Lines nearer to each other than this share of their length intersect. */
const crossing = 1e-7;

/** What the pointer can snap to. */
export interface SnapTargets {
  readonly points: readonly { readonly id: number; readonly position: Position }[];
  readonly lines: readonly LinePath[];
}

/** A line near the pointer, with the place on it under the pointer. */
interface NearLine {
  readonly path: LinePath;
  readonly segment: number;
  readonly position: Position;
  readonly pixels: number;
}

/**
 * Returns the point, intersection, middle or line that the pointer snaps to; null if none is near. Points come first, then
 * special places on lines, then the nearest place on a line. O(points and samples).
 */
export function snapToModel({ points, lines }: SnapTargets, view: PointerView): Snap | null {
  const point = nearest(points, reaches.point, view, ({ position }) => position);
  if (point) return { kind: "point", position: point.position, id: point.id };
  const near = linesNear(lines, view, reaches.intersection);
  const crossed = nearest(intersections(near), reaches.intersection, view, ({ position }) => position);
  if (crossed) return { kind: "intersection", id: null, ...crossed };
  const middles = near.map(({ path }) => ({ id: path.line.id, position: middleOf(path.positions) }));
  const middle = nearest(middles, reaches.middle, view, ({ position }) => position);
  if (middle) return { kind: "middle", ...middle, lines: [middle.id] };
  const [line] = near.filter(({ pixels }) => pixels <= reaches.line).toSorted((a, b) => a.pixels - b.pixels);
  if (!line) return null;
  const { id } = line.path.line;
  return { kind: "line", position: line.position, id, lines: [id] };
}

function nearest<Item>(
  items: readonly Item[],
  reach: number,
  view: PointerView,
  positionOf: (item: Item) => Position,
): Item | null {
  let best: Item | null = null;
  let least = reach;
  for (const item of items) {
    const at = view.toScreen(positionOf(item));
    const pixels = at ? Math.hypot(at.x - view.pointer.x, at.y - view.pointer.y) : Infinity;
    if (pixels > least) continue;
    best = item;
    least = pixels;
  }
  return best;
}

/** Returns the lines within reach of the pointer. */
function linesNear(lines: readonly LinePath[], view: PointerView, reach: number): NearLine[] {
  return lines.flatMap((path) => {
    let [segment, least] = [-1, reach];
    let before = path.positions[0] && view.toScreen(path.positions[0]);
    for (let i = 1; i < path.positions.length; ++i) {
      const position = path.positions[i];
      const at = position ? view.toScreen(position) : null;
      const pixels = before && at ? pixelsFrom(view.pointer, before, at) : Infinity;
      if (pixels < least) [segment, least] = [i - 1, pixels];
      before = at;
    }
    const [a, b] = [path.positions[segment], path.positions[segment + 1]];
    return a && b ? [{ path, segment, position: nearestToRay(view.ray, a, b), pixels: least }] : [];
  });
}

/** Returns the distance of a point of the screen from a segment. */
function pixelsFrom(at: ScreenPoint, a: ScreenPoint, b: ScreenPoint): number {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const squared = dx * dx + dy * dy;
  const share = squared === 0 ? 0 : ((at.x - a.x) * dx + (at.y - a.y) * dy) / squared;
  const along = Math.min(1, Math.max(0, share));
  return Math.hypot(a.x + along * dx - at.x, a.y + along * dy - at.y);
}

/** Returns the position of a segment that is nearest to a ray. */
export function nearestToRay({ origin, direction }: Ray, a: Position, b: Position): Position {
  const edge = subtract(b, a);
  const across = cross(edge, direction);
  const squared = dot(across, across);
  if (squared === 0) return a;
  // The plane through the ray along the common normal cuts the segment at the nearest position.
  const share = dot(cross(subtract(origin, a), direction), across) / squared;
  return between(a, b, Math.min(1, Math.max(0, share)));
}

/** Returns where lines near the pointer intersect. */
function intersections(near: readonly NearLine[]) {
  return near.flatMap((one, i) =>
    near.slice(i + 1).flatMap((other) => {
      const [a, b] = [one.path.positions[one.segment], one.path.positions[one.segment + 1]];
      const [c, d] = [other.path.positions[other.segment], other.path.positions[other.segment + 1]];
      const found = a && b && c && d ? crossingOf(a, b, c, d) : null;
      return found ? [{ position: found, lines: [one.path.line.id, other.path.line.id] }] : [];
    }),
  );
}

/** Returns where two segments cross; null if they do not, or are parallel. */
export function crossingOf(a: Position, b: Position, c: Position, d: Position): Position | null {
  const [u, v, w] = [subtract(b, a), subtract(d, c), subtract(c, a)];
  const normal = cross(u, v);
  const squared = dot(normal, normal);
  const size = Math.max(length(u), length(v));
  if (squared <= 1e-18 * size ** 4) return null;
  const [s, t] = [dot(cross(w, v), normal) / squared, dot(cross(w, u), normal) / squared];
  const isWithin = (share: number): boolean => share >= -crossing && share <= 1 + crossing;
  if (!isWithin(s) || !isWithin(t)) return null;
  const [p, q] = [between(a, b, s), between(c, d, t)];
  return distance(p, q) <= crossing * size ? between(p, q, 0.5) : null;
}

/** Returns the position halfway along a path, by length. */
export function middleOf(positions: readonly Position[]): Position {
  const lengths = positions.slice(1).map((position, i) => distance(positions[i] ?? position, position));
  let left = lengths.reduce((sum, one) => sum + one, 0) / 2;
  for (const [i, step] of lengths.entries()) {
    const [a, b] = [positions[i], positions[i + 1]];
    if (left <= step && a && b) return step === 0 ? a : between(a, b, left / step);
    left -= step;
  }
  return positions.at(-1) ?? [0, 0, 0];
}
