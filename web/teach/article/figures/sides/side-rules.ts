/**
 * The division of a line as the engine divides it (cpp/src/surface/line_mesher.cpp; Löhner & Parikh 1988, section 5.1, steps S1 to
 * S4), with every averaging of S3, for display. A test compares it with the engine.
 */
import { lineEnd, type SizeCurve } from "./size-curve";

/** Constants of cpp/src/surface/rules.h, by the same names; a test compares them. */
export const sideConstants = { kStepTolerance: 1e-3, kMaxAverages: 20, kMaxBisections: 40 } as const;

/** Which size a side gets: that at its middle, as in the paper, or that where it begins. */
export type SideRule = "middle" | "start";

/** One comparison of S2: the tentative length, and the size at the middle of that side. */
export interface Comparison {
  readonly length: number;
  readonly target: number;
}

export interface Side {
  readonly from: number;
  readonly to: number;
  /** S3: length that the side should have; the last side of a line may be shorter. */
  readonly length: number;
  /** Every comparison; each one but the last is followed by an averaging. */
  readonly comparisons: readonly Comparison[];
}

export interface Walk {
  readonly sides: readonly Side[];
  /** Length of the line in sizes. */
  readonly lambda: number;
  /** Positions of the nodes of the finished division: equal parts of lambda. */
  readonly nodes: readonly number[];
}

/** Longest side that is tried. The engine's limit is a sixteenth of the line, so that the bends of a curved line are seen. */
const longest = lineEnd;
/** Most sides of a walk. */
const maxSides = 64;

/** Returns the side that begins at a position (S1 to S3). `tolerance` is the largest relative difference that counts as equal. */
export function settleSide(curve: SizeCurve, from: number, rule: SideRule, tolerance: number): Side {
  const { kMaxAverages, kMaxBisections } = sideConstants;
  let length = curve.sizeAt(from);
  let [tooShort, tooLong] = [0, longest];
  const comparisons: Comparison[] = [];
  for (let round = 0; ; round++) {
    const target = curve.sizeAt(from + 0.5 * length);
    comparisons.push({ length, target });
    const isEqual = Math.abs(target - length) <= tolerance * length;
    if (isEqual || rule === "start" || round === kMaxAverages + kMaxBisections) break;
    if (target > length) tooShort = Math.max(tooShort, length);
    else tooLong = Math.min(tooLong, length);
    length = 0.5 * (round < kMaxAverages ? length + target : tooShort + tooLong);
  }
  return { from, to: from + length, length, comparisons };
}

/** Divides the line from a position to its end: side by side, then into equal parts in sizes. */
export function divide(curve: SizeCurve, begin: number, rule: SideRule, tolerance: number): Walk {
  const sides: Side[] = [];
  for (let from = begin; from < lineEnd && sides.length < maxSides;) {
    const side = settleSide(curve, from, rule, tolerance);
    // A side that would leave a tiny rest ends at the end of the line.
    const to = side.to >= lineEnd - 1e-3 * (lineEnd - from) ? lineEnd : side.to;
    sides.push({ ...side, to });
    from = to;
  }
  const lambda = curve.lambda(begin, lineEnd);
  const count = Math.max(1, Math.floor(lambda + 0.5));
  const nodes = Array.from({ length: count + 1 }, (_none, i) =>
    i === count ? lineEnd : curve.positionAt(begin, (lambda * i) / count, lineEnd),
  );
  return { sides, lambda, nodes };
}

/** Returns how many times as long as the size at its middle the worst side of a walk is; a last side that sticks out does not count. */
export const worstExcess = (curve: SizeCurve, { sides }: Walk): number =>
  Math.max(
    0,
    ...sides
      .filter(({ from, length, to }) => from + length <= to + 1e-9)
      .map(({ from, length }) => length / curve.sizeAt(from + 0.5 * length)),
  );
