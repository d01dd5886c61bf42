/**
 * The ideal point as the engine places it (cpp/src/volume/ideal_point.cpp; Löhner & Parikh 1988, section 2, step F5.1), with the
 * quantities between, for display. The corners lie in the plane z = 0 and go counter-clockwise.
 */
import type { Position } from "../../../../document/position";
import { add, distance, scale } from "../../../../document/vectors";
import { clamp } from "../../kit/motion";

/** Constants of cpp/src/volume/rules.h, by the same names; a test compares them. */
export const idealRules = {
  kEdgePerTarget: 0.97,
  kMinSizePerBase: 0.55,
  kMaxSizePerBase: 2,
  kMinCircumradius: 0.4,
  kMaxCircumradius: 0.95,
  kMinIdealHeight: 0.3,
} as const;

export type Corners = readonly [Position, Position, Position];

const polar = (radius: number, degrees: number): Position => [
  radius * Math.cos((degrees * Math.PI) / 180),
  radius * Math.sin((degrees * Math.PI) / 180),
  0,
];
/** Faces to which words of the text lead. */
export const poses = {
  even: [polar(0.58, -90), polar(0.58, 30), polar(0.58, 150)],
  long: [polar(1.05, -90), polar(0.5, 55), polar(0.5, 125)],
  blunt: [polar(1.02, -165), polar(1.02, -15), polar(0.14, 90)],
} as const satisfies Readonly<Record<string, Corners>>;
export const isPose = (word: string | undefined): word is keyof typeof poses =>
  word !== undefined && Object.hasOwn(poses, word);

/** Limits of h by the size of the face, and of R by h. */
export type SizeLimit = "none" | "small" | "large";
export type RadiusLimit = "none" | "low" | "high";

export interface IdealPoint {
  /** Mean of the corners. */
  readonly mean: Position;
  /** Centre of the circle through the corners. */
  readonly centre: Position;
  readonly radius: number;
  /** What R counts as, within its limits. */
  readonly used: number;
  /** Size of the face: root mean square of its sides. */
  readonly base: number;
  /** Size of the element before its limits. */
  readonly wanted: number;
  /** Size of the element, within its limits. */
  readonly h: number;
  /** h² − R²; negative if no height gives the edges the length h. */
  readonly square: number;
  readonly height: number;
  /** The point above the mean, as the engine places it, or above the centre. */
  readonly position: Position;
  readonly foot: Position;
  /** Lengths of the three new edges. */
  readonly edges: readonly [number, number, number];
  readonly sizeLimit: SizeLimit;
  /** Whether R counts as less, which leaves the point at its lowest height, or as more, which holds it at its highest. */
  readonly radiusLimit: RadiusLimit;
}

/** Returns twice the area; positive for counter-clockwise corners. */
export const doubleArea = ([a, b, c]: Corners): number =>
  (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

export function placeIdealPoint(corners: Corners, targetSize: number, isOverCentre: boolean): IdealPoint {
  const [a, b, c] = corners;
  const sides = [distance(a, b), distance(b, c), distance(c, a)] as const;
  const base = Math.sqrt((sides[0] ** 2 + sides[1] ** 2 + sides[2] ** 2) / 3);
  const radius = (sides[0] * sides[1] * sides[2]) / (2 * doubleArea(corners));
  const wanted = idealRules.kEdgePerTarget * targetSize;
  const h = clamp(wanted, idealRules.kMinSizePerBase * base, idealRules.kMaxSizePerBase * base);
  const used = clamp(radius, idealRules.kMinCircumradius * h, idealRules.kMaxCircumradius * h);
  const root = Math.sqrt(h * h - used * used);
  const height = Math.max(root, idealRules.kMinIdealHeight * h);
  const mean = scale(add(add(a, b), c), 1 / 3);
  const centre = circleCentre(corners);
  const foot = isOverCentre ? centre : mean;
  const position: Position = [foot[0], foot[1], height];
  const edges = [distance(a, position), distance(b, position), distance(c, position)] as const;
  const square = h * h - radius * radius;
  return {
    mean,
    centre,
    radius,
    used,
    base,
    wanted,
    h,
    square,
    height,
    position,
    foot,
    edges,
    sizeLimit: wanted < h ? "small" : wanted > h ? "large" : "none",
    radiusLimit: radius > used ? "low" : radius < used ? "high" : "none",
  };
}

/** Returns the centre of the circle through three corners in the plane z = 0. */
export function circleCentre([a, b, c]: Corners): Position {
  const d = 2 * (a[0] * (b[1] - c[1]) + b[0] * (c[1] - a[1]) + c[0] * (a[1] - b[1]));
  const q = (p: Position): number => p[0] * p[0] + p[1] * p[1];
  return [
    (q(a) * (b[1] - c[1]) + q(b) * (c[1] - a[1]) + q(c) * (a[1] - b[1])) / d,
    (q(a) * (c[0] - b[0]) + q(b) * (a[0] - c[0]) + q(c) * (b[0] - a[0])) / d,
    0,
  ];
}

/** Returns whether a point of the plane is within the triangle. */
export function isWithin(point: Position, [a, b, c]: Corners): boolean {
  const pairs = [
    [a, b],
    [b, c],
    [c, a],
  ] as const;
  return pairs.every(([u, v]) => doubleArea([u, v, point]) > 0);
}
