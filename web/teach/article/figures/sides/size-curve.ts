/** A size curve over a line: linear between knots, as sizes are between the nodes of a background grid. */
import { clamp } from "../../kit/motion";

/** Position on the line, and the size there. */
export type Knot = readonly [number, number];

/** The line goes from 0 to this position. */
export const lineEnd = 8;
export const sizeLimits = { min: 0.3, max: 2.6 } as const;
/** Smallest distance between two knots. */
const minGap = 0.25;

export const curves: Readonly<Record<string, readonly Knot[]>> = {
  valley: [
    [0, 2.1],
    [2.7, 0.65],
    [3.9, 0.5],
    [5.7, 1.3],
    [8, 1.75],
  ],
  bowl: [
    [0, 2.2],
    [2.1, 1.8],
    [4, 0.9],
    [5.9, 1.2],
    [8, 2.1],
  ],
  ramp: [
    [0, 0.6],
    [2.2, 0.6],
    [4.4, 1.9],
    [5.8, 1.9],
    [8, 0.8],
  ],
};

export class SizeCurve {
  constructor(readonly knots: readonly Knot[]) {}

  /** Returns the size at a position; beyond the ends, that of the nearest end. */
  sizeAt(x: number): number {
    const next = this.knots.findIndex(([at]) => at >= x);
    const [to, from] = [this.knots[next], this.knots[next - 1]];
    if (!to) return this.knots.at(-1)?.[1] ?? 1;
    if (!from) return to[1];
    return from[1] + ((x - from[0]) / (to[0] - from[0])) * (to[1] - from[1]);
  }

  /** Returns the slope of the curve just after a position. */
  slopeAt(x: number): number {
    const next = this.knots.findIndex(([at]) => at > x);
    const [to, from] = [this.knots[next], this.knots[next - 1]];
    return to && from ? (to[1] - from[1]) / (to[0] - from[0]) : 0;
  }

  /** Returns the curve with one knot moved, between its neighbours; the ends of the line keep their positions. */
  withKnot(index: number, [x, size]: Knot): SizeCurve {
    const [before, after] = [this.knots[index - 1], this.knots[index + 1]];
    const at =
      before && after ? clamp(x, before[0] + minGap, after[0] - minGap) : (this.knots[index]?.[0] ?? x);
    return new SizeCurve(this.knots.with(index, [at, clamp(size, sizeLimits.min, sizeLimits.max)]));
  }

  /** Length of the line between two positions, in sizes: the integral of 1 / size. */
  lambda(from: number, to: number): number {
    return this.#pieces(from, to).reduce((sum, [a, b]) => sum + this.#lambdaOfPiece(a, b), 0);
  }

  /** Returns the position up to which the line is `lambda` sizes long, counted from a position. */
  positionAt(from: number, lambda: number, end: number): number {
    let left = lambda;
    for (const [a, b] of this.#pieces(from, end)) {
      const whole = this.#lambdaOfPiece(a, b);
      if (left > whole) {
        left -= whole;
        continue;
      }
      const [size, slope] = [this.sizeAt(a), (this.sizeAt(b) - this.sizeAt(a)) / (b - a)];
      return a + (Math.abs(slope) < 1e-9 ? left * size : (size * Math.expm1(slope * left)) / slope);
    }
    return end;
  }

  /** Intervals on which the curve is linear. */
  #pieces(from: number, to: number): readonly (readonly [number, number])[] {
    const cuts = [from, ...this.knots.map(([x]) => x).filter((x) => x > from && x < to), to];
    return cuts.slice(1).map((b, i) => [cuts[i] ?? from, b]);
  }

  #lambdaOfPiece(a: number, b: number): number {
    const [first, last] = [this.sizeAt(a), this.sizeAt(b)];
    const slope = (last - first) / (b - a);
    return Math.abs(slope) < 1e-9 ? (b - a) / first : Math.log(last / first) / slope;
  }
}

/** Returns a curve between two with equally many knots. */
export function between(from: SizeCurve, to: SizeCurve, t: number): SizeCurve {
  return new SizeCurve(
    to.knots.map(([x, size], i): Knot => {
      const [x0, size0] = from.knots[i] ?? [x, size];
      return [x0 + (x - x0) * t, size0 + (size - size0) * t];
    }),
  );
}
