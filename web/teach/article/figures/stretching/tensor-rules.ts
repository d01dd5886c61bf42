/**
 * Size, stretching and direction in the plane as one tensor H = size · [I + (stretching − 1) a aᵀ], as the engine makes it
 * (cpp/src/field/size_tensor.h; Löhner & Parikh 1988, sections 2 and 3), and what becomes of triangles in its space, u = H⁻¹ x.
 */
import type { PlaneFront, PlaneNode } from "tetrafront/trace";
import type { PlanePoint } from "../../kit/plane-view";

/** What edges should be like at a node of the background grid. */
export interface Ellipse {
  readonly at: PlanePoint;
  /** Length of edges across the direction. */
  readonly size: number;
  /** Length of edges along the direction / size. */
  readonly stretching: number;
  /** Direction in degrees, counter-clockwise from the x axis. */
  readonly angle: number;
}

/** A symmetric matrix: its entries xx, xy and yy. */
export type Tensor = readonly [number, number, number];

export const limits = { size: { min: 0.05, max: 0.2 }, along: 0.6 } as const;

export const directionOf = (angle: number): PlanePoint => [
  Math.cos((angle * Math.PI) / 180),
  Math.sin((angle * Math.PI) / 180),
];

export function tensorOf({ size, stretching, angle }: Omit<Ellipse, "at">): Tensor {
  const [x, y] = directionOf(angle);
  const extra = size * (stretching - 1);
  return [size + extra * x * x, extra * x * y, size + extra * y * y];
}

/** Returns H⁻¹ x. */
export function intoSpaceOf([xx, xy, yy]: Tensor, [x, y]: PlanePoint): PlanePoint {
  const determinant = xx * yy - xy * xy;
  return [(yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant];
}

/** Returns H u. */
export const outOfSpaceOf = ([xx, xy, yy]: Tensor, [u, v]: PlanePoint): PlanePoint => [
  xx * u + xy * v,
  xy * u + yy * v,
];

/** Returns size, stretching and direction of a tensor. */
export function ellipseOf([xx, xy, yy]: Tensor): Omit<Ellipse, "at"> {
  const [middle, radius] = [(xx + yy) / 2, Math.hypot((xx - yy) / 2, xy)];
  const size = middle - radius;
  return {
    size,
    stretching: (middle + radius) / size,
    angle: radius < 1e-12 * middle ? 0 : (Math.atan2(2 * xy, xx - yy) * 90) / Math.PI,
  };
}

/** Ellipses at the corners of a rectangle, from (0, 0) to `extent`, and in its middle: a background grid of four triangles. */
export class TensorField {
  readonly #tensors: readonly Tensor[];

  constructor(
    /** One ellipse that holds everywhere; or those at the corners, counter-clockwise from (0, 0), and in the middle. */
    readonly ellipses: readonly Ellipse[],
    readonly extent: PlanePoint,
  ) {
    this.#tensors = ellipses.map(tensorOf);
  }

  get nodes(): readonly PlaneNode[] {
    return this.ellipses.map(({ at, size, stretching, angle }) => ({
      position: at,
      size,
      stretching,
      direction: directionOf(angle),
    }));
  }

  /** Returns the tensor at a position: its entries are linear in each triangle of the background grid. */
  tensorAt([x, y]: PlanePoint): Tensor {
    const tensors = this.#tensors;
    const first: Tensor = tensors[0] ?? [1, 0, 1];
    const middle = tensors[4];
    if (!middle) return first;
    // From −1 to 1 in both directions; the larger one tells the triangle.
    const [u, v] = [(2 * x) / this.extent[0] - 1, (2 * y) / this.extent[1] - 1];
    const out = Math.min(1, Math.max(Math.abs(u), Math.abs(v)));
    const isUpright = Math.abs(v) >= Math.abs(u);
    const side = isUpright ? (v < 0 ? 0 : 2) : u > 0 ? 1 : 3;
    const along = out === 0 ? 0 : ([u, v, -u, -v][side] ?? 0);
    const weights = [(out - along) / 2, (out + along) / 2] as const;
    const [from, to] = [tensors[side] ?? first, tensors[(side + 1) % 4] ?? first];
    return [0, 1, 2].map(
      (i) => (from[i] ?? 0) * weights[0] + (to[i] ?? 0) * weights[1] + (middle[i] ?? 0) * (1 - out),
    ) as unknown as Tensor;
  }
}

export type Triangle = readonly [PlanePoint, PlanePoint, PlanePoint];

/**
 * How many times as long as wide a triangle is: the ratio of the axes of the ellipse through its corners around its centroid. It is
 * 1 for the equilateral triangle, and s for one that was stretched by s.
 */
export function aspectOf(triangle: Triangle): number {
  const shape = shapeOf(triangle);
  return shape > 0 ? (1 + Math.sqrt(Math.max(0, 1 - shape * shape))) / shape : Infinity;
}

/** The shape of a triangle: 4 √3 area / sum of its squared edges; 1 for the equilateral triangle, 0 for one without area. */
export function shapeOf([a, b, c]: Triangle): number {
  const doubled = Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  const squares = [
    [a, b],
    [b, c],
    [c, a],
  ].map(([p = a, q = b]) => (p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2);
  const sum = squares.reduce((total, square) => total + square, 0);
  return sum > 0 ? (2 * Math.sqrt(3) * doubled) / sum : 0;
}

export const centroidOf = ([a, b, c]: Triangle): PlanePoint => [
  (a[0] + b[0] + c[0]) / 3,
  (a[1] + b[1] + c[1]) / 3,
];

export function contains([a, b, c]: Triangle, p: PlanePoint): boolean {
  const side = (from: PlanePoint, to: PlanePoint): number =>
    (to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]);
  const sides = [side(a, b), side(b, c), side(c, a)];
  return sides.every((each) => each >= 0) || sides.every((each) => each <= 0);
}

export const fillField = (
  front: PlaneFront,
  outline: readonly PlanePoint[],
  field: TensorField,
): ReturnType<PlaneFront["fill"]> =>
  front.fill([outline], { nodes: field.nodes }, { order: "layered", improve: false });
