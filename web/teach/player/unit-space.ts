/**
 * The space in which the target element of a step is regular (Löhner & Parikh 1988, section 3): positions divided by the size
 * tensor; without stretching, space itself. The numbers of the ideal point and of distances in it, with the constants of
 * cpp/src/volume/rules.h.
 */
import type { AdvanceStep, Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { cross, dot, subtract } from "../../document/vectors";
import type { Triangle } from "./crossing";
import { cornersOf } from "./judge";
import { nearestOnFace } from "./overlap";

export type Axes = readonly [Position, Position, Position];

const edgePerTarget = 0.97;
/** Limits of the element size, in sizes of the base face. */
const minSizePerBase = 0.55;
const maxSizePerBase = 2;
/** Limits of the circumradius, and least height of the ideal point, in element sizes. */
const minRadius = 0.4;
const maxRadius = 0.95;
const minHeight = 0.3;
/** Least distance of a new node from faces that its element does not touch, in element sizes, per rule class. */
const faceDistances = [0.35, 0.2, 0.08, 0, 0] as const;

/** Returns the columns of the tensor that maps the space of regular elements to space. */
export function unitAxes({ tensor }: AdvanceStep): Axes {
  const [xx, yy, zz, xy, xz, yz] = tensor ?? [1, 1, 1, 0, 0, 0];
  return [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
}

/** Returns the coordinates of a position along axes that need not be perpendicular. */
function inUnitSpace(position: Position, [first, second, third]: Axes): Position {
  const volume = dot(first, cross(second, third));
  return [
    dot(position, cross(second, third)) / volume,
    dot(position, cross(third, first)) / volume,
    dot(position, cross(first, second)) / volume,
  ];
}

/** Lengths of a step in the space of regular elements. */
export interface IdealNumbers {
  readonly target: number;
  /** Root mean square of the edge lengths of the base face. */
  readonly base: number;
  /** Length h that the edges of the new element should have. */
  readonly size: number;
  /** Radius of the circle through the corners of the base face. */
  readonly radius: number;
  /** Height of the ideal point above the centroid of the base face. */
  readonly height: number;
}

/** Returns the numbers by which the ideal point of a step is placed (step F5.1). */
export function idealNumbers(trace: Trace, step: AdvanceStep): IdealNumbers {
  const axes = unitAxes(step);
  const [a, b, c] = cornersOf(trace, step.face);
  const edges = [subtract(b, a), subtract(c, b), subtract(a, c)].map((edge) => inUnitSpace(edge, axes));
  const [ab = [0, 0, 0], bc = [0, 0, 0]] = edges;
  const base = Math.sqrt(edges.reduce((sum, edge) => sum + dot(edge, edge), 0) / 3);
  const size = clamp(edgePerTarget * step.targetEdge, minSizePerBase * base, maxSizePerBase * base);
  const product = edges.reduce((length, edge) => length * Math.hypot(...edge), 1);
  const radius = product / (2 * Math.hypot(...cross(ab, bc)));
  const used = clamp(radius, minRadius * size, maxRadius * size);
  const height = Math.max(Math.sqrt(size * size - used * used), minHeight * size);
  return { target: step.targetEdge, base, size, radius, height };
}

/** A distance between a new node and a face, and the least one that the rules allow, both in element sizes. */
export interface FaceDistance {
  readonly distance: number;
  readonly least: number;
}

/** Returns the distance of a position from a face, in the space of regular elements. */
export function distanceToFace(
  trace: Trace,
  step: AdvanceStep,
  position: Position,
  face: number,
): FaceDistance {
  const axes = unitAxes(step);
  const [a, b, c] = cornersOf(trace, face);
  const corners: Triangle = [inUnitSpace(a, axes), inUnitSpace(b, axes), inUnitSpace(c, axes)];
  const at = inUnitSpace(position, axes);
  const { size } = idealNumbers(trace, step);
  return {
    distance: Math.hypot(...subtract(at, nearestOnFace(corners, at))) / size,
    least: faceDistances[step.ruleClass] ?? 0,
  };
}

const clamp = (value: number, low: number, high: number): number => Math.min(Math.max(value, low), high);
