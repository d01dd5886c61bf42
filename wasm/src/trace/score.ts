/** What the scores of candidates are made of: in space as recorded, in the plane from positions and the metric of the step. */
import {
  CAPTURE_RADIUS,
  CLOSING_BONUS,
  LOW_NEW_NODE_WEIGHT,
  MAX_LENGTH_RATIO,
  MIN_LENGTH_RATIO,
  NEW_NODE_HEIGHTS,
  NEW_NODE_WEIGHT,
  POCKET_BONUS,
  WEDGE_BONUS,
} from "../generated/constants.js";
import { LOW_WEIGHT_BIT, WEDGE_BIT } from "./layout.js";
import type { Pair, PlaneSample } from "./surface-events.js";
import type { TraceCursor } from "./trace-cursor.js";

/** The parts of a score, which add up to it. Parts that do not apply to a candidate are 0. */
export interface ScoreParts {
  /** Shape of the element: the cube of its mean ratio, 1 for a regular one. */
  readonly shape: number;
  /** Existing nodes: for each edge of the base face at which there is a face of the front with this node. */
  readonly closing: number;
  /** Existing nodes: 1 for the node of such a face at a dihedral angle below 90°, which is preferred. */
  readonly wedge: number;
  /** Existing nodes: 10 if the front has all three faces, so that the element fills a pocket. */
  readonly pocket: number;
  /** New nodes, negative: they weigh less than existing ones. */
  readonly newNode: number;
  /** New nodes, negative: below the height of the ideal point they weigh less again. */
  readonly height: number;
}

/** A score as it was recorded; `parts` is null in files that do not have them. */
export interface RecordedScore {
  readonly score: number;
  readonly parts: ScoreParts | null;
}

const nothing: ScoreParts = { shape: 0, closing: 0, wedge: 0, pocket: 0, newNode: 0, height: 0 };

const cube = (x: number): number => x * x * x;

/** Edges of a base face. */
const EDGES = 3;

/** Reads a score and its terms. */
export function readScore(cursor: TraceCursor, isNew: boolean): RecordedScore {
  const score = cursor.shorterFloat();
  const terms = cursor.byte();
  return { score, parts: isNew ? newNodeParts(cursor, score, terms) : nodeParts(cursor, score, terms) };
}

/** Reads a score of an earlier version of the file. */
export const readShortScore = (cursor: TraceCursor): RecordedScore => ({
  score: cursor.score(),
  parts: null,
});

function nodeParts(cursor: TraceCursor, score: number, terms: number): ScoreParts {
  const closed = terms % WEDGE_BIT;
  if (terms >= 2 * WEDGE_BIT) cursor.fail(`there is no term ${terms} of a score`, cursor.at - 1);
  const wedge = terms >= WEDGE_BIT ? WEDGE_BONUS : 0;
  const pocket = closed === EDGES ? POCKET_BONUS : 0;
  const product = score - wedge - pocket;
  const shape = product / cube(1 + closed * CLOSING_BONUS);
  return { ...nothing, shape, closing: product - shape, wedge, pocket };
}

function newNodeParts(cursor: TraceCursor, score: number, terms: number): ScoreParts {
  const height = NEW_NODE_HEIGHTS[terms % LOW_WEIGHT_BIT];
  if (height === undefined || terms >= 2 * LOW_WEIGHT_BIT)
    return cursor.fail(`there is no term ${terms} of a score`, cursor.at - 1);
  const weight = terms >= LOW_WEIGHT_BIT ? LOW_NEW_NODE_WEIGHT : NEW_NODE_WEIGHT;
  const weighted = score / cube(height) / cube(height);
  const shape = weighted / cube(weight);
  return { ...nothing, shape, newNode: weighted - shape, height: score - weighted };
}

/** The parts of a score in the plane, which add up to it. Parts that do not apply to a candidate are 0. */
export interface PlaneScoreParts {
  /** Shape of the triangle in space: 1 for equal sides; 0 for candidates at the ideal point. */
  readonly shape: number;
  /** Candidates at the ideal point: 2, more than any shape. */
  readonly ideal: number;
  /**
   * Candidates at the ideal point, negative: the distance from it, in lengths of the new edges. A new node counts as far away as
   * a node may be to replace it: 0.55.
   */
  readonly distance: number;
}

/** The best score: of a node at the ideal point. */
const BEST_PLANE_SCORE = 2;

/** A base edge in the plane, with what its candidates are compared with. */
export interface PlaneBase extends Pick<PlaneSample, "metric"> {
  readonly ends: readonly [Pair, Pair];
  readonly ideal: Pair;
}

/**
 * Returns the parts of the score of a candidate in the plane, as the front computes them, with the digits of the recorded metric.
 * The highest score is tried first.
 */
export function planeScoreParts(base: PlaneBase, plane: Pair, isNew: boolean): PlaneScoreParts {
  const { ends, ideal, metric } = base;
  const captured = (distance: number): PlaneScoreParts => ({
    shape: 0,
    ideal: BEST_PLANE_SCORE,
    distance: -distance,
  });
  if (isNew) return captured(CAPTURE_RADIUS);
  const [a, b] = ends;
  const ab = minus(b, a);
  const length = Math.sqrt(squareIn(metric, ab));
  const target = Math.min(Math.max(1, MIN_LENGTH_RATIO * length), MAX_LENGTH_RATIO * length);
  const away = Math.sqrt(squareIn(metric, minus(plane, ideal))) / target;
  if (away < CAPTURE_RADIUS) return captured(away);
  const [xx, xy, yy] = metric;
  const ap = minus(plane, a);
  const doubleArea = Math.sqrt(xx * yy - xy * xy) * (ab[0] * ap[1] - ab[1] * ap[0]);
  const squares = squareIn(metric, ab) + squareIn(metric, ap) + squareIn(metric, minus(plane, b));
  return { shape: (2 * Math.sqrt(3) * doubleArea) / squares, ideal: 0, distance: 0 };
}

/** Returns the sum of the parts of a score. */
export const planeScore = ({ shape, ideal, distance }: PlaneScoreParts): number => shape + ideal + distance;

const squareIn = ([xx, xy, yy]: PlaneSample["metric"], [x, y]: Pair): number =>
  xx * x * x + 2 * xy * x * y + yy * y * y;
const minus = (a: Pair, b: Pair): Pair => [a[0] - b[0], a[1] - b[1]];
