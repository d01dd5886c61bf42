/** Shapes that were triangulated by themselves, in common arrays: welding and orientation. */
import { plural } from "../base/plural.js";
import { inRanges, type Steps, stepwise } from "../base/steps.js";
import {
  type Corners,
  cross,
  dot,
  lengthOf,
  minus,
  normalOf,
  plus,
  pointOf,
  type Vector,
} from "../base/vectors.js";
import type { MeshGroup } from "../mesh/mesh.js";
import { differentNames, listed } from "./groups.js";
import { diagonalOf, weldWithin } from "./near-points.js";
import { weldPoints } from "./weld.js";

/** A face of a shape, which becomes a patch. */
export interface ShapeFace {
  /** Undefined for faces that are numbered; empty for triangles of a shape that are nothing in particular. */
  readonly name?: string | undefined;
  /** Number of its triangles, which follow those of the face before it. */
  readonly triangles: number;
  readonly color: MeshGroup["color"];
}

export interface Shape {
  /** Empty if the file has none. */
  readonly name: string;
  /** x y z per node. */
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  readonly faces: readonly ShapeFace[];
  /** Largest volume of its tetrahedra; 0 or undefined without a limit. */
  readonly maxVolume?: number | undefined;
}

/** All shapes of a file. */
export interface JoinedShapes {
  /** One per shape, all different. */
  readonly names: readonly string[];
  /** x y z per node. */
  points: Float64Array;
  /** Three nodes per triangle. */
  readonly triangles: Uint32Array;
  /** Per triangle: its shape, and its face among those of all shapes. Triangles are in the order of both. */
  readonly shapeOf: Uint32Array;
  readonly faceOf: Uint32Array;
  /** Per triangle: one of the face of another shape that it is part of too; itself without one. */
  readonly twin: Uint32Array;
  /** Per triangle: 1 if it is left out. */
  readonly isDropped: Uint8Array;
  /** Sentences about what was changed. */
  readonly notes: string[];
}

export function joinedShapes(shapes: readonly Shape[]): JoinedShapes {
  const count = shapes.reduce((sum, { triangles }) => sum + triangles.length / 3, 0);
  const joined: JoinedShapes = {
    names: differentNames(shapes.map(({ name }, s) => (name === "" ? `solid ${s + 1}` : name))),
    points: new Float64Array(shapes.reduce((sum, { points }) => sum + points.length, 0)),
    triangles: new Uint32Array(3 * count),
    shapeOf: new Uint32Array(count),
    faceOf: new Uint32Array(count),
    twin: Uint32Array.from(new Uint8Array(count).keys()),
    isDropped: new Uint8Array(count),
    notes: [],
  };
  let [node, triangle, face] = [0, 0, 0];
  for (const [s, { points, triangles, faces }] of shapes.entries()) {
    const first = node;
    joined.points.set(points, 3 * first);
    joined.triangles.set(
      triangles.map((corner) => corner + first),
      3 * triangle,
    );
    joined.shapeOf.fill(s, triangle, triangle + triangles.length / 3);
    let at = triangle;
    for (const { triangles: number } of faces) {
      joined.faceOf.fill(face++, at, at + number);
      at += number;
    }
    node += points.length / 3;
    triangle += triangles.length / 3;
  }
  return joined;
}

/** Distance within which nodes are welded, relative to the diagonal: far below any detail, above the rounding. */
const WELD = 1e-7;

/**
 * Welds equal nodes, then, if edges are open or there are several shapes, near ones. Drops what has no area left. Returns
 * the shapes that are not closed.
 */
export function* weldShapes(joined: JoinedShapes): Steps<ReadonlySet<number>> {
  const exact = yield* weldPoints(joined.points);
  yield* renumber(joined, exact.indices);
  joined.points = exact.points;
  const isClosed = joined.names.length === 1 && (yield* openShapes(joined)).size === 0;
  if (!isClosed) {
    const distance = WELD * diagonalOf(joined.points);
    const near = yield* weldWithin(joined.points, distance);
    const moved = (joined.points.length - near.points.length) / 3;
    if (moved > 0)
      joined.notes.push(
        `welded ${plural(moved, "node")} to others within ${Number(distance.toPrecision(2))}`,
      );
    yield* renumber(joined, near.indices);
    joined.points = near.points;
  }
  let flat = 0;
  const { triangles, isDropped } = joined;
  yield* stepwise(isDropped.length, (t) => {
    const [a, b, c] = triangles.subarray(3 * t, 3 * t + 3);
    if (a !== b && b !== c && c !== a) return;
    isDropped[t] = 1;
    flat++;
  });
  if (flat > 0) joined.notes.push(`left out ${plural(flat, "triangle")} without area`);
  return isClosed ? new Set() : yield* openShapes(joined);
}

function* renumber({ triangles }: JoinedShapes, indices: Uint32Array): Steps<void> {
  yield* stepwise(triangles.length, (i) => {
    triangles[i] = indices[triangles[i] ?? 0] ?? 0;
  });
}

/** Returns the shapes that have an edge with an odd number of triangles. */
function* openShapes({ points, triangles, shapeOf, isDropped }: JoinedShapes): Steps<Set<number>> {
  const open = new Set<number>();
  const nodes = points.length / 3;
  for (let begin = 0; begin < shapeOf.length;) {
    const shape = shapeOf[begin] ?? 0;
    let end = begin + 1;
    while (shapeOf[end] === shape) end++;
    const keys = new Float64Array(3 * (end - begin));
    let used = 0;
    const first = begin;
    yield* stepwise(end - begin, (i) => {
      const t = first + i;
      if (isDropped[t] === 1) return;
      for (let k = 0; k < 3; k++) {
        const [a = 0, b = 0] = [triangles[3 * t + k], triangles[3 * t + ((k + 1) % 3)]];
        if (a !== b) keys[used++] = Math.min(a, b) * nodes + Math.max(a, b);
      }
    });
    if (hasOddRun(keys.subarray(0, used).sort())) open.add(shape);
    begin = end;
  }
  return open;
}

/** Returns whether a value occurs an odd number of times. */
function hasOddRun(sorted: Float64Array): boolean {
  for (let i = 0; i < sorted.length;) {
    let next = i + 1;
    while (sorted[next] === sorted[i]) next++;
    if ((next - i) % 2 === 1) return true;
    i = next;
  }
  return false;
}

/** Volume / area^(3/2) below which the sign is rounding, as of a flat shape: such a shape is not flipped. */
const SMALLEST_VOLUME = 1e-9;

/** Flips shapes whose triangles face inward: mirrored parts of an assembly. */
export function* orientShapes(joined: JoinedShapes): Steps<void> {
  const { names, triangles, shapeOf, isDropped } = joined;
  const sums = names.map(() => new VolumeSum());
  yield* stepwise(shapeOf.length, (t) => {
    if (isDropped[t] === 0) sums[shapeOf[t] ?? 0]?.add(cornersOf(joined, t));
  });
  const flipped = [...sums.keys()].filter((s) => sums[s]?.isInverted() === true);
  if (flipped.length === 0) return;
  const isFlipped = new Set(flipped);
  yield* inRanges(shapeOf.length, (begin, end) => {
    for (let t = begin; t < end; t++) {
      if (!isFlipped.has(shapeOf[t] ?? 0)) continue;
      const second = triangles[3 * t + 1] ?? 0;
      triangles[3 * t + 1] = triangles[3 * t + 2] ?? 0;
      triangles[3 * t + 2] = second;
    }
  });
  joined.notes.push(`flipped: ${namesOf(joined, flipped)}`);
}

/** Sums up the volume that the triangles of a shape enclose with the centre of them all, which also open shapes have. */
class VolumeSum {
  #count = 0;
  #doubledArea = 0;
  #sixfoldVolume = 0;
  #normal: Vector = [0, 0, 0];
  #corners: Vector = [0, 0, 0];

  add(corners: Corners): void {
    const [a, b, c] = corners;
    const normal = normalOf(corners);
    this.#count += 3;
    this.#doubledArea += lengthOf(normal);
    this.#sixfoldVolume += dot(a, cross(b, c));
    this.#normal = plus(this.#normal, normal);
    this.#corners = corners.reduce(plus, this.#corners);
  }

  /** Returns whether the triangles face inward. */
  isInverted(): boolean {
    const volume = (this.#sixfoldVolume - dot(this.#corners, this.#normal) / this.#count) / 6;
    return volume < -SMALLEST_VOLUME * (this.#doubledArea / 2) ** 1.5;
  }
}

/** Returns the names of shapes, in quotes. */
export function namesOf({ names }: JoinedShapes, shapes: Iterable<number>): string {
  return listed([...shapes].map((s) => `"${names[s] ?? ""}"`));
}

/** Returns the corners of a triangle, relative to the first node of all. */
export function cornersOf({ points, triangles }: JoinedShapes, t: number): Corners {
  const first = pointOf(points, 0);
  const corner = (k: number): Vector => minus(pointOf(points, triangles[3 * t + k] ?? 0), first);
  return [corner(0), corner(1), corner(2)];
}

/** Returns six times the signed volume of the tetrahedron of a triangle and the first node of all. */
export function sixfoldVolumeBelow(joined: JoinedShapes, t: number): number {
  const [a, b, c] = cornersOf(joined, t);
  return dot(a, cross(b, c));
}

/** Returns twice the area of a triangle. */
export const doubledAreaOf = (joined: JoinedShapes, t: number): number =>
  lengthOf(normalOf(cornersOf(joined, t)));
