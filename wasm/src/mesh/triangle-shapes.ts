/** Shapes of the triangles of a surface: whether a mesh that keeps them is fit for use. */
import { type Steps, stepwise } from "../base/steps.js";
import type { SurfaceInput } from "./mesh.js";

/** Angle, in degrees, below which a triangle is a needle or a cap: elements next to it have angles as small. */
const NEEDLE_ANGLE = 10;
/** Share of needles above which the mesh is of little use: each has several elements next to it, and one poor element in a hundred is too many. */
const MAX_NEEDLES = 0.02;
/**
 * Angle, in degrees, below which a single triangle leaves elements that spoil a computation. Beside one of 0.03° among good ones,
 * optimized elements have 6.5°; beside one of 0.6°, 14°; of 1.8°, 21°.
 */
const HARMFUL_ANGLE = 0.5;

/** How many triangles of a surface are needles. */
export interface TriangleShapes {
  readonly triangles: number;
  /** Number of triangles that are needles or caps. */
  readonly needles: number;
  /** Degrees. */
  readonly smallestAngle: number;
  /** Whether a mesh that keeps the triangles can be used: few are needles, and none spoils the elements beside it. */
  readonly isFit: boolean;
  /** Mean edge length of the other triangles, if they state the size that is wanted because few are needles; else undefined. */
  readonly statedSize?: number | undefined;
}

/** Measures all triangles of a surface with valid indices. O(n). */
export function* triangleShapes({ points, triangles }: SurfaceInput): Steps<TriangleShapes> {
  const count = triangles.length / 3;
  let needles = 0;
  let smallestAngle = count === 0 ? 0 : 180;
  let length = 0;
  yield* stepwise(count, (t) => {
    const edges = edgesOf(points, triangles.subarray(3 * t, 3 * t + 3));
    const angle = smallestAngleOf(edges);
    if (angle < NEEDLE_ANGLE) needles++;
    else length += edges[0] + edges[1] + edges[2];
    if (angle < smallestAngle) smallestAngle = angle;
  });
  const areFew = count > 0 && needles <= MAX_NEEDLES * count;
  const isFit = count === 0 || (areFew && smallestAngle >= HARMFUL_ANGLE);
  const statedSize = areFew ? length / (3 * (count - needles)) : undefined;
  return { triangles: count, needles, smallestAngle, isFit, statedSize };
}

type Edges = readonly [number, number, number];

function edgesOf(points: Float64Array, [a = 0, b = 0, c = 0]: Uint32Array): Edges {
  return [distance(points, a, b), distance(points, b, c), distance(points, c, a)];
}

/** Returns the smallest angle of a triangle in degrees, 0 without area or of invalid nodes. */
function smallestAngleOf(edges: Edges): number {
  const [p = 0, q = 0, r = 0] = edges.toSorted((x, y) => x - y);
  // Half the angle opposite the shortest edge, by the half-angle formula, which is exact for needles too.
  const sum = p + q + r;
  const square = ((p + q - r) * (p + r - q)) / (sum * (q + r - p));
  return square > 0 ? (360 / Math.PI) * Math.atan(Math.sqrt(square)) : 0;
}

function distance(points: Float64Array, a: number, b: number): number {
  const along = (axis: number) => (points[3 * b + axis] ?? 0) - (points[3 * a + axis] ?? 0);
  return Math.hypot(along(0), along(1), along(2));
}
