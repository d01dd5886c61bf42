/**
 * A patch between four curved lines, its unit square, and the square stretched and sheared to resemble it (Löhner & Parikh 1988,
 * appendix, equations 15 to 17), as the engine has them (cpp/src/model/transfinite_surface.h, stretched_plane.h).
 */
import type { Position } from "../../../../document/position";
import {
  add,
  addScaled,
  between,
  cross,
  distance,
  dot,
  length,
  scale,
  subtract,
} from "../../../../document/vectors";
import type { PlanePoint } from "../../kit/plane-view";

/** Corners A, B, C and D, one after the other round the patch. */
export type Corners = readonly [Position, Position, Position, Position];

/** How far the middle of a line is from the chord: of A B, B C, D C and A D, for the bulge 1. */
const bulges: readonly [Position, Position, Position, Position] = [
  [0, -0.08, 0.52],
  [0.1, 0, 0.2],
  [0, 0.06, 0.02],
  [-0.12, 0, 0.3],
];
export const startCorners: Corners = [
  [-1.15, -0.5, -0.12],
  [1.15, -0.55, -0.22],
  [0.72, 0.56, 0.06],
  [-0.9, 0.52, 0],
];
/** Cosine of 20°: outside 20° to 160° at A, the engine stretches no square. */
const largestCosine = Math.cos(Math.PI / 9);
/** Pieces in which the length of a line is measured. */
const pieces = 64;

export interface SurfacePoint {
  readonly position: Position;
  /** Derivatives along ξ and η. */
  readonly alongXi: Position;
  readonly alongEta: Position;
}

/** A symmetric matrix: its entries xx, xy and yy. */
export type Metric = readonly [number, number, number];

export class SurfaceMaps {
  /** x of B, C and D in the stretched square, and y of C and D; A is (0, 0). */
  readonly xB: number;
  readonly xC: number;
  readonly xD: number;
  readonly yD: number;

  constructor(
    readonly corners: Corners,
    readonly bulge: number,
  ) {
    const { alongXi, alongEta } = this.pointAt([0, 0]);
    const product = length(alongXi) * length(alongEta);
    const cosine = product > 0 ? dot(alongXi, alongEta) / product : 0;
    const limited = Math.min(largestCosine, Math.max(-largestCosine, cosine));
    const [lengthAB, , lengthDC, lengthAD] = [0, 1, 2, 3].map((line) => this.#lengthOf(line)) as [
      number,
      number,
      number,
      number,
    ];
    this.xB = lengthAB;
    this.xD = lengthAD * limited;
    this.xC = this.xD + lengthDC;
    this.yD = lengthAD * Math.sqrt(1 - limited * limited);
  }

  /** Corners of the stretched square. */
  get plane(): readonly PlanePoint[] {
    return [
      [0, 0],
      [this.xB, 0],
      [this.xC, this.yD],
      [this.xD, this.yD],
    ];
  }

  /** Equation 15: the bilinear Coons patch. */
  pointAt([xi, eta]: PlanePoint): SurfacePoint {
    const [a, b, c, d] = this.corners;
    const [ab, bc, dc, ad] = [this.#line(0, xi), this.#line(1, eta), this.#line(2, xi), this.#line(3, eta)];
    const corner = (of: Position, weight: number): Position => scale(of, -weight);
    const sum = (...terms: readonly Position[]): Position => terms.reduce(add);
    const position = sum(
      scale(ab.at, 1 - eta),
      scale(bc.at, xi),
      scale(dc.at, eta),
      scale(ad.at, 1 - xi),
      corner(a, (1 - xi) * (1 - eta)),
      corner(b, xi * (1 - eta)),
      corner(c, xi * eta),
      corner(d, (1 - xi) * eta),
    );
    const alongXi = sum(
      scale(ab.along, 1 - eta),
      bc.at,
      scale(dc.along, eta),
      scale(ad.at, -1),
      corner(a, eta - 1),
      corner(b, 1 - eta),
      corner(c, eta),
      corner(d, -eta),
    );
    const alongEta = sum(
      scale(ab.at, -1),
      scale(bc.along, xi),
      dc.at,
      scale(ad.along, 1 - xi),
      corner(a, xi - 1),
      corner(b, -xi),
      corner(c, xi),
      corner(d, 1 - xi),
    );
    return { position, alongXi, alongEta };
  }

  /** Equation 16: from the unit square to the stretched one. */
  toPlane([xi, eta]: PlanePoint): PlanePoint {
    return [this.xB * xi + this.xD * eta + this.#shear * xi * eta, this.yD * eta];
  }

  /** Equation 17: the way back. */
  toUnit([x, y]: PlanePoint): PlanePoint {
    const eta = y / this.yD;
    return [(x - this.xD * eta) / (this.xB + this.#shear * eta), eta];
  }

  /** Squares of lengths in space of steps in the unit square: the first fundamental form. */
  metricAt(unit: PlanePoint): Metric {
    const { alongXi, alongEta } = this.pointAt(unit);
    return [dot(alongXi, alongXi), dot(alongXi, alongEta), dot(alongEta, alongEta)];
  }

  /** The same for steps in the stretched square: G, by which its front measures. */
  planeMetricAt(unit: PlanePoint): Metric {
    const { alongXi, alongEta } = this.pointAt(unit);
    const [byXi, byEta] = this.#planeDerivatives(unit);
    const alongX = scale(alongXi, 1 / byXi);
    const alongY = scale(addScaled(alongEta, alongXi, -byEta / byXi), 1 / this.yD);
    return [dot(alongX, alongX), dot(alongX, alongY), dot(alongY, alongY)];
  }

  /** Returns where three corners of a triangle lie in the unit square: it is equilateral in space, at a point of the surface. */
  evenTriangle(unit: PlanePoint, radius: number): readonly [PlanePoint, PlanePoint, PlanePoint] {
    const [xx, xy, yy] = this.metricAt(unit);
    // Steps of length 1 in space: along ξ, and across it.
    const across = Math.sqrt(yy - (xy * xy) / xx);
    return [-90, 30, 150].map((degrees): PlanePoint => {
      const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
      const eta = (radius * s) / across;
      return [unit[0] + (radius * c) / Math.sqrt(xx) - (eta * xy) / xx, unit[1] + eta];
    }) as unknown as readonly [PlanePoint, PlanePoint, PlanePoint];
  }

  /** Returns a step of the unit square at a point as a step of the stretched one. */
  stepToPlane(unit: PlanePoint, [dx, dy]: PlanePoint): PlanePoint {
    const [byXi, byEta] = this.#planeDerivatives(unit);
    return [byXi * dx + byEta * dy, this.yD * dy];
  }

  /** Whether the patch is far from folding over: its area nowhere vanishes, neighbouring pieces look the same way, no line is short. */
  get isSound(): boolean {
    const [a, b, c, d] = this.corners;
    const sides = [distance(a, b), distance(b, c), distance(c, d), distance(d, a)];
    if (Math.min(...sides) < 0.45 || this.yD < 0.4 || this.xC - this.xD < 0.3) return false;
    const steps = [0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1];
    const normals = steps.map((eta) =>
      steps.map((xi) => {
        const { alongXi, alongEta } = this.pointAt([xi, eta]);
        return cross(alongXi, alongEta);
      }),
    );
    return normals.every((row, j) =>
      row.every((normal, i) => {
        const neighbours = [row[i + 1], normals[j + 1]?.[i]];
        return length(normal) > 0.1 && neighbours.every((each) => !each || dot(normal, each) > 0);
      }),
    );
  }

  get #shear(): number {
    return this.xC - this.xB - this.xD;
  }

  /** Derivatives of x along ξ and η; y changes along η alone, by yD. */
  #planeDerivatives([xi, eta]: PlanePoint): readonly [number, number] {
    return [this.xB + this.#shear * eta, this.xD + this.#shear * xi];
  }

  #line(index: number, t: number): { readonly at: Position; readonly along: Position } {
    const [a, b, c, d] = this.corners;
    const [from, to] = [[a, b] as const, [b, c] as const, [d, c] as const, [a, d] as const][index] ?? [a, b];
    const bow = scale(bulges[index] ?? [0, 0, 0], this.bulge);
    return {
      at: addScaled(between(from, to, t), bow, 4 * t * (1 - t)),
      along: addScaled(subtract(to, from), bow, 4 * (1 - 2 * t)),
    };
  }

  #lengthOf(line: number): number {
    let sum = 0;
    for (let i = 0; i < pieces; i++)
      sum += distance(this.#line(line, i / pieces).at, this.#line(line, (i + 1) / pieces).at);
    return sum;
  }
}

/** Returns the angles of a triangle in degrees, in the plane or in space. */
export function anglesOf(corners: readonly (readonly number[])[]): readonly number[] {
  return corners.map((at, i) => {
    const [u, v] = [1, 2].map((by) =>
      (corners[(i + by) % 3] ?? at).map((x, axis) => x - (at[axis] ?? 0)),
    ) as [number[], number[]];
    const product = (p: readonly number[], q: readonly number[]): number =>
      p.reduce((sum, x, axis) => sum + x * (q[axis] ?? 0), 0);
    const cosine = product(u, v) / Math.sqrt(product(u, u) * product(v, v));
    return (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI;
  });
}

/** Largest difference from the angles of an equilateral triangle, in degrees. */
export const lossOf = (angles: readonly number[]): number =>
  Math.max(...angles.map((angle) => Math.abs(angle - 60)));
