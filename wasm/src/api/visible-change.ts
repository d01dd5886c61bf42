/** Whether a repair changed what one sees of a surface. */
import {
  centroidOf,
  cornersOf,
  cross,
  dot,
  lengthOf,
  minus,
  normalOf,
  type Vector,
} from "../base/vectors.js";
import { diagonalOf } from "../formats/near-points.js";
import { NO_ORIGIN } from "../generated/constants.js";
import type { RepairChange } from "../mesh/inspection.js";
import type { Mesh, SurfaceInput } from "../mesh/mesh.js";

/** A surface after a repair. */
interface Repaired {
  readonly surface: Mesh;
  readonly changes?: readonly RepairChange[] | undefined;
  readonly repairDeviation?: number | undefined;
}

/** Length / diagonal below which a change cannot be seen. */
const VISIBLE = 1e-3;

/** Area / area of the surface below which added or removed triangles cannot be seen. */
const VISIBLE_AREA = 1e-4;

/** Largest number of removed triangles that are looked at, the largest first. */
const MAX_REMOVED = 64;

/** Winding number above which a position is inside a closed surface, or on it. */
const INSIDE = 0.25;

/**
 * Returns whether a repair moved a node, moved the box of the surface, filled a hole or removed triangles so that it can be
 * seen. Parts inside bodies that intersect are removed without being seen.
 */
export function isVisiblyChanged(given: Mesh, made: Repaired): boolean {
  const { surface, changes = [], repairDeviation = 0 } = made;
  if (changes.length === 0) return false;
  const limit = VISIBLE * diagonalOf(given.points);
  if (repairDeviation > limit || hasOtherBox(given, surface, limit)) return true;
  const smallest = VISIBLE_AREA * areaOf(given, all(given));
  const areSeen = (of: SurfaceInput, triangles: readonly number[]) =>
    areaOf(of, triangles) > smallest && triangles.some((t) => widthOf(of, t) > limit);
  const filled = all(surface).filter((t) => surface.origin?.[t] === NO_ORIGIN);
  if (areSeen(surface, filled)) return true;
  const removed = changes
    .flatMap((change) => (isRemoved(change) ? [change.triangle] : []))
    .toSorted((a, b) => areaOfTriangle(given, b) - areaOfTriangle(given, a))
    .slice(0, MAX_REMOVED);
  return areSeen(
    given,
    removed.filter((t) => windingNumber(surface, centroidOf(cornersOf(given, t))) < INSIDE),
  );
}

/** Changes after which each triangle is where it was, except those without an area and those that were there twice. */
const KEEPING: ReadonlySet<RepairChange["kind"]> = new Set([
  "welded-node",
  "removed-node",
  "removed-triangle",
  "removed-duplicate",
  "flipped-triangle",
]);

/** Returns whether a repair kept all triangles that a mesh can have. */
export function keepsTriangles({ changes = [] }: Pick<Repaired, "changes">): boolean {
  return changes.every(({ kind }) => KEEPING.has(kind));
}

/** Returns whether a change removed a whole triangle that has an area, and whose place none other has taken. */
const isRemoved = (
  change: RepairChange,
): change is Extract<RepairChange, { readonly kind: "removed-sheet" | "resolved-intersection" }> =>
  change.kind === "removed-sheet" || (change.kind === "resolved-intersection" && change.parts === 0);

/** Returns how often a surface that faces outward winds around a position: 1 inside, 0 outside; by solid angles. O(n). */
function windingNumber(surface: SurfaceInput, position: Vector): number {
  const sum = all(surface).reduce((angle, t) => {
    const [a, b, c] = cornersOf(surface, t).map((corner) => minus(corner, position)) as [
      Vector,
      Vector,
      Vector,
    ];
    const [x, y, z] = [lengthOf(a), lengthOf(b), lengthOf(c)];
    const below = x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y;
    return angle + 2 * Math.atan2(dot(a, cross(b, c)), below);
  }, 0);
  return sum / (4 * Math.PI);
}

const all = ({ triangles }: SurfaceInput): number[] =>
  Array.from({ length: triangles.length / 3 }, (_, t) => t);

const areaOfTriangle = (surface: SurfaceInput, t: number): number =>
  lengthOf(normalOf(cornersOf(surface, t))) / 2;

const areaOf = (surface: SurfaceInput, triangles: readonly number[]): number =>
  triangles.reduce((sum, t) => sum + areaOfTriangle(surface, t), 0);

/** Returns the smallest height of a triangle. */
function widthOf(surface: SurfaceInput, t: number): number {
  const [a, b, c] = cornersOf(surface, t);
  const longest = Math.max(lengthOf(minus(b, a)), lengthOf(minus(c, b)), lengthOf(minus(a, c)));
  return longest > 0 ? (2 * areaOfTriangle(surface, t)) / longest : 0;
}

function hasOtherBox(one: SurfaceInput, other: SurfaceInput, limit: number): boolean {
  const [a, b] = [boxOf(one), boxOf(other)];
  return a.some((value, k) => Math.abs(value - (b[k] ?? value)) > limit);
}

/** Returns the least and the greatest coordinates of the nodes that triangles use. */
function boxOf({ points, triangles }: SurfaceInput): readonly number[] {
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (const node of triangles) {
    for (let axis = 0; axis < 3; axis++) {
      const x = points[3 * node + axis] ?? 0;
      box[axis] = Math.min(box[axis] ?? x, x);
      box[3 + axis] = Math.max(box[3 + axis] ?? x, x);
    }
  }
  return box;
}
