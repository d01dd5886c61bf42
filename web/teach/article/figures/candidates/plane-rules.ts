/**
 * The candidates over one side of a front in the plane. What is tried, and what becomes of it, is the record of the engine's own
 * step; which nodes were ranked after the accepted one is not recorded, and follows from the engine's rules (a test compares).
 */
import type { EdgeRefusal, PlaneFront, PlaneScoreParts } from "tetrafront/trace";
import type { PlanePoint } from "../../kit/plane-view";

/** A node nearer to the ideal point than this, in lengths of the new sides, can replace it. */
export const captureRadius = 0.55;
/** Candidates are looked for this far around the ideal point, in lengths of the longer of the new sides and the base. */
const searchRadius = 1.7;
/** Triangles of other nodes must have at least this shape. */
const minShape = 0.3;
/** A score that no shape reaches: of a node at the ideal point. */
const bestScore = 2;

export interface PlaneCandidate {
  /** Number of the corner; null for a new node. */
  readonly corner: number | null;
  readonly at: PlanePoint;
  readonly parts: PlaneScoreParts;
  readonly score: number;
  /** Shape of its triangle: 1 for equal sides. */
  readonly shape: number;
  readonly verdict: "accepted" | EdgeRefusal | "not tried";
  /** The side in the way. */
  readonly culprit: readonly [PlanePoint, PlanePoint] | null;
}

export interface PlaneStep {
  readonly ideal: PlanePoint;
  /** Length of the new sides. */
  readonly target: number;
  /** All that were ranked, in their order. */
  readonly candidates: readonly PlaneCandidate[];
  /** Number of them, as the engine has recorded it. */
  readonly ranked: number;
}

/**
 * Lets the engine take the first side of a polygon, from corner 1 to corner 2, counter-clockwise. Returns the message if the
 * polygon is impossible.
 */
export function firstStep(
  front: PlaneFront,
  corners: readonly PlanePoint[],
  size: number,
): PlaneStep | string {
  const filled = front.fill([corners], size, {
    order: "first-in",
    boundary: "given",
    maxSteps: 1,
    improve: false,
  });
  if (!filled.success) return filled.message;
  const step = filled.trace.stepAt(filled.front.firstStep + 1);
  if (step?.kind !== "edge") return "The front has no step.";
  const cornerAt = (node: number | null): number | null =>
    node === null || node >= corners.length ? null : node;
  const pointOf = (node: number): PlanePoint => [
    filled.front.plane[2 * node] ?? 0,
    filled.front.plane[2 * node + 1] ?? 0,
  ];
  const base = measureBase(corners, size);
  const tried = step.candidates.map(
    ({ node, isNew, plane, parts, score, verdict, culprit }): PlaneCandidate => {
      const ends = [0, 1].map((i) => pointOf(filled.front.edges[2 * (culprit ?? 0) + i] ?? 0));
      return {
        corner: isNew ? null : cornerAt(node),
        at: plane,
        parts,
        score,
        shape: shapeOf(base, plane),
        verdict,
        culprit: culprit === null ? null : (ends as unknown as readonly [PlanePoint, PlanePoint]),
      };
    },
  );
  const known = new Set(tried.map(({ corner }) => corner));
  const others = rankedBy(corners, base, step.ideal).filter(({ corner }) => !known.has(corner));
  return {
    ideal: step.ideal,
    target: base.target,
    candidates: [...tried, ...others],
    ranked: step.rankedCandidates,
  };
}

interface Base {
  readonly from: PlanePoint;
  readonly to: PlanePoint;
  readonly length: number;
  readonly target: number;
}

function measureBase([from = [0, 0], to = [0, 0]]: readonly PlanePoint[], size: number): Base {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  return { from, to, length, target: Math.min(Math.max(size, 0.55 * length), 2 * length) };
}

/** Returns the shape of the triangle over a base, 0 for a flat one and below for one behind the base. */
function shapeOf({ from, to, length }: Base, [x, y]: PlanePoint): number {
  const doubled = (to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0]);
  const squares = (x - from[0]) ** 2 + (y - from[1]) ** 2 + (x - to[0]) ** 2 + (y - to[1]) ** 2;
  return (2 * Math.sqrt(3) * doubled) / (length * length + squares);
}

/** Returns the ranked candidates by the engine's rules for the first try of a side. */
function rankedBy(corners: readonly PlanePoint[], base: Base, ideal: PlanePoint): readonly PlaneCandidate[] {
  const reach = searchRadius * Math.max(base.target, base.length);
  const [low, high] = [0, 1].map((axis) => {
    const all = [
      base.from[axis] ?? 0,
      base.to[axis] ?? 0,
      (ideal[axis] ?? 0) - reach,
      (ideal[axis] ?? 0) + reach,
    ];
    return [Math.min(...all), Math.max(...all)] as const;
  }) as [readonly [number, number], readonly [number, number]];
  const found: PlaneCandidate[] = [];
  const add = (corner: number | null, at: PlanePoint, parts: PlaneScoreParts): void => {
    const score = parts.shape + parts.ideal + parts.distance;
    found.push({ corner, at, parts, score, shape: shapeOf(base, at), verdict: "not tried", culprit: null });
  };
  corners.forEach((at, corner) => {
    const [x, y] = at;
    if (corner < 2 || x < low[0] || x > low[1] || y < high[0] || y > high[1]) return;
    const away = Math.hypot(x - ideal[0], y - ideal[1]) / base.target;
    const shape = shapeOf(base, at);
    if (away < captureRadius) add(corner, at, { shape: 0, ideal: bestScore, distance: -away });
    else if (shape >= minShape) add(corner, at, { shape, ideal: 0, distance: 0 });
  });
  add(null, ideal, { shape: 0, ideal: bestScore, distance: -captureRadius });
  return found.sort((a, b) => b.score - a.score);
}
