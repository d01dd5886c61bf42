/** The race of lesson 7: a wing in a channel, with small triangles at the wing, filled in four orders. */
import type { PlaneFront } from "tetrafront/trace";
import type { PlanePoint } from "../../kit/plane-view";

export const orders = ["smallest-first", "first-in", "random", "layered"] as const;
export type Order = (typeof orders)[number];

/** The channel goes from (0, 0) to these coordinates. */
export const channel: PlanePoint = [1.6, 0.9];
/** Where the wing is in the beginning. */
export const centre: PlanePoint = [0.72, 0.48];
const chord = 0.3;
/** Sizes at the wing, and far from it. */
const [fine, coarse] = [0.03, 0.3] as const;
/** Up to this distance from a source, the size is that at the wing. */
const reach = 0.04;
/** Distance of the wing's middle from the walls. */
const margin = 0.22;

/** Outline of the wing; its chord is 1 long, and the nose is on the left. */
const outline: readonly PlanePoint[] = [
  [0.5, 0],
  [0.3, 0.045],
  [0.05, 0.09],
  [-0.25, 0.1],
  [-0.45, 0.05],
  [-0.5, 0],
  [-0.45, -0.04],
  [-0.25, -0.065],
  [0.05, -0.05],
  [0.3, -0.025],
];
/** Positions of the sources along the chord. */
const sources = [-0.45, -0.2, 0.1, 0.45] as const;

export interface Wing {
  readonly at: PlanePoint;
  /** Degrees by which the tail is below the nose. */
  readonly angle: number;
}

/** Returns a point of the wing, given in lengths of its chord. */
export function onWing({ at, angle }: Wing, [x, y]: PlanePoint): PlanePoint {
  const [c, s] = [Math.cos((angle * Math.PI) / 180), -Math.sin((angle * Math.PI) / 180)];
  return [at[0] + chord * (x * c - y * s), at[1] + chord * (x * s + y * c)];
}

export const outlineOf = (wing: Wing): readonly PlanePoint[] => outline.map((point) => onWing(wing, point));

/** Returns a position that leaves room for the wing at any angle. */
export const withinChannel = ([x, y]: PlanePoint): PlanePoint => [
  Math.min(channel[0] - margin, Math.max(margin, x)),
  Math.min(channel[1] - margin, Math.max(margin, y)),
];

export function loopsOf(wing: Wing): readonly (readonly PlanePoint[])[] {
  const walls: readonly PlanePoint[] = [[0, 0], [channel[0], 0], channel, [0, channel[1]]];
  return [walls, outlineOf(wing)];
}

/** Fills the channel. `growth` is that of the size per unit of distance from the wing. `improve` moves nodes and flips edges afterwards. */
export function fillChannel(
  front: PlaneFront,
  wing: Wing,
  growth: number,
  order: Order,
  improve = false,
): ReturnType<PlaneFront["fill"]> {
  const sizes = {
    size: coarse,
    sources: sources.map((x) => ({ position: onWing(wing, [x, 0]), size: fine, distance: reach, growth })),
  };
  return front.fill(loopsOf(wing), sizes, { order, improve, seed: 1 });
}
