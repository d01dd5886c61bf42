/** Paths of the plane of a patch, in its own coordinates, for SVG. */
import type { EdgeStep, PlanarFront, PlanePosition } from "tetrafront/trace";
import { edgesAt, endsOf, planeOf, targetLength } from "./planar-judge";
import { trianglesMadeAt } from "./surface-scene";

/** A rectangle of the plane: its left and upper border, its width and height, and the larger of them. */
export interface PlaneWindow {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
  readonly size: number;
}

/** Width of the margin around a patch, as a share of its size. */
const margin = 0.06;
/** Width of the window around a base edge, in target sizes there. */
const closeUp = 9;

/** Returns the rectangle around a patch. */
export function windowOf({ plane, boundaryNodes }: PlanarFront): PlaneWindow {
  let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let node = 0; node < boundaryNodes; node++) {
    const [x = 0, y = 0] = plane.subarray(2 * node, 2 * node + 2);
    left = Math.min(left, x);
    right = Math.max(right, x);
    bottom = Math.min(bottom, y);
    top = Math.max(top, y);
  }
  const border = margin * Math.max(right - left, top - bottom);
  const [width, height] = [right - left + 2 * border, top - bottom + 2 * border];
  return { left: left - border, top: top + border, width, height, size: Math.max(width, height) };
}

/** Name, position and node of a corner of the quadrilateral that a curved patch is mapped to. */
export interface PlaneCorner {
  readonly name: "A" | "B" | "C" | "D";
  readonly at: PlanePosition;
  readonly node: number;
}

/**
 * Returns the corners of the mapping of equation 16: A at the origin, B beside it, D and C above; of a triangle, A, B and D.
 * Empty for flat patches, which are not mapped, and for tubes, whose plane has seams instead.
 */
export function cornersOfPlane({ plane, boundaryNodes, isCurved, seamNodes }: PlanarFront): PlaneCorner[] {
  if (!isCurved || seamNodes > 0) return [];
  const nodes = Array.from({ length: boundaryNodes }, (_, node) => {
    const [x = 0, y = 0] = plane.subarray(2 * node, 2 * node + 2);
    return { at: [x, y] as const, node };
  });
  const height = Math.max(...nodes.map(({ at: [, y] }) => y));
  const tolerance = 1e-9 * height;
  const alongLine = (level: number) =>
    nodes.filter(({ at: [, y] }) => Math.abs(y - level) <= tolerance).sort((a, b) => a.at[0] - b.at[0]);
  const [alongBottom, alongTop] = [alongLine(0), alongLine(height)];
  const [a, b] = [alongBottom[0], alongBottom.at(-1)];
  const [d, c] = [alongTop[0], alongTop.at(-1)];
  if (!a || !b || !c || !d || a === b || Math.abs(a.at[0]) > tolerance) return [];
  return [
    { name: "A", ...a },
    { name: "B", ...b },
    ...(c === d ? [] : [{ name: "C", ...c } as const]),
    { name: "D", ...d },
  ];
}

/** Returns the square around a base edge. */
export function windowAround(front: PlanarFront, step: EdgeStep): PlaneWindow {
  const { rx, ry } = ellipseOf(step, targetLength(front, step));
  const size = closeUp * Math.max(rx, ry);
  const [x, y] = step.ideal;
  return { left: x - size / 2, top: y + size / 2, width: size, height: size, size };
}

/**
 * Returns the ellipse of all steps of the plane that are as long in space, in target sizes: half axes, and the angle of
 * the first in degrees.
 */
export function ellipseOf({ metric: [xx, xy, yy] }: EdgeStep, length: number) {
  const mean = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  return {
    rx: length / Math.sqrt(Math.max(mean - spread, Number.MIN_VALUE)),
    ry: length / Math.sqrt(mean + spread),
    // The longer axis belongs to the smaller eigenvalue.
    angle: (Math.atan2(2 * xy, xx - yy) / 2) * (180 / Math.PI) + 90,
  };
}

export interface PlanePaths {
  readonly triangles: string;
  readonly boundary: string;
  readonly front: string;
  /** A point at each end of an edge of the front: a line without length, to be drawn with round ends. */
  readonly nodes: string;
  readonly triangleCount: number;
  readonly edgeCount: number;
}

/** Returns what a state has: the triangles made so far, or those of the improved patch. O(patch). */
export function planePaths(front: PlanarFront, state: number): PlanePaths {
  const improved = state >= front.lastStep ? front.improved : null;
  const { plane, triangles } = improved ?? front;
  const count = improved ? triangles.length / 3 : trianglesMadeAt(front, state);
  const at = (node: number): string => `${plane[2 * node] ?? 0} ${plane[2 * node + 1] ?? 0}`;
  let path = "";
  for (let i = 0; i < count; i++) {
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * i, 3 * i + 3);
    path += `M${at(a)}L${at(b)}L${at(c)}Z`;
  }
  const edges = improved ? [] : edgesAt(front, state);
  return {
    triangles: path,
    boundary: segments(front, edgesAt(front, front.firstStep)),
    front: segments(front, edges),
    nodes: edges.map((edge) => `M${planeOf(front, endsOf(front, edge)[0]).join(" ")}h0`).join(""),
    triangleCount: count,
    edgeCount: edges.length,
  };
}

function segments(front: PlanarFront, edges: readonly number[]): string {
  return edges
    .map((edge) => {
      const [from, to] = endsOf(front, edge);
      return `M${planeOf(front, from).join(" ")}L${planeOf(front, to).join(" ")}`;
    })
    .join("");
}
