/**
 * The candidates over one face of a front in space. The engine has recorded which it tried, their scores and what became of them;
 * which were ranked after the accepted one follows from its rules (cpp/src/volume/candidates.cpp; a test compares all steps).
 */
import type { AdvanceStep, Refusal, ScoreParts, Trace } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import { addScaled, cross, distance, dot, length, mean, scale, subtract } from "../../../../document/vectors";

export type Triangle = readonly [number, number, number];

/** Parts of the score that a reader can change. */
export interface Weights {
  /** Weight of the mean ratio of a new node. */
  readonly newNode: number;
  /** What the corner of a face at an acute angle gets. */
  readonly wedge: number;
  /** Per closed side, as a share. */
  readonly closing: number;
}

/** The engine's own. */
export const ownWeights: Weights = { newNode: 0.85, wedge: 1, closing: 0.03 };

export interface SpaceCandidate {
  /** Index of the node; null for a new one. */
  readonly node: number | null;
  readonly at: Position;
  /** Cube of the mean ratio. */
  readonly shape: number;
  /** Sides of the base at which a face of the front has this node. */
  readonly closed: number;
  readonly isWedge: boolean;
  /** Of a new node: its height as a factor of the ideal one. */
  readonly height: number;
  readonly verdict: "accepted" | Refusal | "not tried";
  /** Index of the face in the way. */
  readonly culprit: number | null;
}

export interface SpaceStep {
  readonly step: number;
  /** Counter-clockwise seen from the empty side. */
  readonly base: readonly [Position, Position, Position];
  readonly ideal: Position;
  readonly candidates: readonly SpaceCandidate[];
  /** Number of candidates that the engine has ranked. */
  readonly ranked: number;
  /** Faces of the front before the step, without the base. */
  readonly faces: readonly { readonly index: number; readonly nodes: Triangle }[];
}

/** Rules of the engine for a face that is tried for the first time. */
const rules = { searchRadius: 0.9, minQuality: 0.35, nodeDistance: 0.8, wedgeQuality: 0.05 } as const;
const heights = [1, 0.85, 0.7, 0.55, 0.4] as const;
/** The target length is multiplied by this, and is at least and at most these multiples of the base's size. */
const [edgePerTarget, minSize, maxSize] = [0.97, 0.55, 2] as const;

const cube = (x: number): number => x * x * x;

/** Returns the parts of a score for some weights; they add up to it. */
export function partsOf(
  { node, shape, closed, isWedge, height }: SpaceCandidate,
  weights: Weights,
): ScoreParts {
  const nothing = { closing: 0, wedge: 0, pocket: 0, newNode: 0, height: 0 };
  if (node === null) {
    const weighted = shape * cube(weights.newNode);
    const lowered = weighted * cube(height) * cube(height);
    return { ...nothing, shape, newNode: weighted - shape, height: lowered - weighted };
  }
  return {
    ...nothing,
    shape,
    closing: shape * (cube(1 + weights.closing * closed) - 1),
    wedge: isWedge ? weights.wedge : 0,
    pocket: closed >= 3 ? 10 : 0,
  };
}

export function scoreOf(candidate: SpaceCandidate, weights: Weights): number {
  const { shape, closing, wedge, pocket, newNode, height } = partsOf(candidate, weights);
  return shape + closing + wedge + pocket + newNode + height;
}

/** Returns candidates in the order in which they are tried. */
export function rankBy(candidates: readonly SpaceCandidate[], weights: Weights): readonly SpaceCandidate[] {
  const scores = new Map(candidates.map((each) => [each, scoreOf(each, weights)]));
  return [...candidates].sort(
    (a, b) => (scores.get(b) ?? 0) - (scores.get(a) ?? 0) || (a.node ?? Infinity) - (b.node ?? Infinity),
  );
}

/** Returns a step of a trace with all of its candidates, in the engine's order; null if no face is tried in it. O(faces). */
export function spaceStepAt(trace: Trace, k: number): SpaceStep | null {
  const step = trace.stepAt(k);
  if (step?.kind !== "advance") return null;
  const { positions } = trace.nodes;
  const at = (node: number): Position => [
    positions[3 * node] ?? 0,
    positions[3 * node + 1] ?? 0,
    positions[3 * node + 2] ?? 0,
  ];
  const nodesOf = (face: number): Triangle =>
    [...trace.faces.nodes.subarray(3 * face, 3 * face + 3)] as unknown as Triangle;
  const faces: { index: number; nodes: Triangle }[] = [];
  const { born, died } = trace.faces;
  for (let face = 0; face < born.length; face++)
    if ((born[face] ?? 0) < k && (died[face] ?? 0) >= k && face !== step.face)
      faces.push({ index: face, nodes: nodesOf(face) });
  const baseNodes = nodesOf(step.face);
  const base = baseNodes.map(at) as unknown as readonly [Position, Position, Position];
  const all = candidatesOver(step, baseNodes, base, faces, at);
  // What was tried comes first, as it was recorded; of equal scores, only the engine knows which was first.
  const left = [...rankBy(all, ownWeights)];
  const tried = step.candidates.flatMap(({ node, isNew, position, verdict, culprit }) => {
    const index = left.findIndex((each) =>
      isNew ? each.node === null && distance(position, each.at) < 1e-5 : each.node === node,
    );
    return left
      .splice(index, index < 0 ? 0 : 1)
      .map((each): SpaceCandidate => ({ ...each, verdict, culprit }));
  });
  const candidates = [...tried, ...left];
  return { step: k, base, ideal: step.idealPoint, candidates, ranked: step.rankedCandidates, faces };
}

function candidatesOver(
  step: AdvanceStep,
  baseNodes: Triangle,
  base: readonly [Position, Position, Position],
  faces: readonly { readonly nodes: Triangle }[],
  at: (node: number) => Position,
): readonly SpaceCandidate[] {
  const [a, b, c] = base;
  const normal = cross(subtract(b, a), subtract(c, a));
  const sides = [subtract(b, a), subtract(c, b), subtract(a, c)];
  const squares = sides.reduce((sum, side) => sum + dot(side, side), 0);
  const size = Math.sqrt(squares / 3);
  const h = Math.min(Math.max(edgePerTarget * step.targetEdge, minSize * size), maxSize * size);
  const shapeOf = (apex: Position): number => {
    const sixVolumes = dot(normal, subtract(apex, a));
    if (!(sixVolumes > 0)) return 0;
    const sum = base.reduce(
      (total, corner) => total + dot(subtract(apex, corner), subtract(apex, corner)),
      squares,
    );
    return (432 * sixVolumes * sixVolumes) / cube(sum);
  };
  const best = (12 * dot(normal, normal)) / (squares * squares);
  const minShape = cube(rules.minQuality) * Math.min(1, best);
  const closed = new Map<number, number>();
  const wedges = new Set<number>();
  for (const { nodes } of faces)
    for (let i = 0; i < 3; i++) {
      // The neighbour has the side of the base in the other direction.
      const [from = -1, to = -1, apex = -1] = [nodes[i], nodes[(i + 1) % 3], nodes[(i + 2) % 3]];
      const side = baseNodes.findIndex((node, k) => node === to && baseNodes[(k + 1) % 3] === from);
      if (side < 0) continue;
      closed.set(apex, (closed.get(apex) ?? 0) + 1);
      const third = at(baseNodes[(side + 2) % 3] ?? 0);
      if (isWedge(at(to), at(from), third, at(apex), normal)) wedges.add(apex);
    }
  const nodes = new Set(faces.flatMap((face) => [...face.nodes]));
  for (const node of baseNodes) nodes.delete(node);
  const found: SpaceCandidate[] = [];
  const positions = [...nodes].map((node) => [node, at(node)] as const);
  for (const [node, position] of positions) {
    const count = Math.min(3, closed.get(node) ?? 0);
    const isAcute = count > 0 && wedges.has(node);
    if (dot(normal, subtract(position, a)) <= 0) continue;
    if (!isAcute && distance(position, step.idealPoint) > rules.searchRadius * h) continue;
    const shape = shapeOf(position);
    if (count < 3 && shape < minShape * (isAcute ? rules.wedgeQuality : 1)) continue;
    const common = { node, at: position, shape, closed: count, isWedge: isAcute, height: 1 };
    found.push({ ...common, verdict: "not tried", culprit: null });
  }
  const foot = mean(base);
  for (const height of heights) {
    const position = addScaled(foot, subtract(step.idealPoint, foot), height);
    const shape = shapeOf(position);
    if (!(shape > 0) || shape < minShape) continue;
    const room = rules.nodeDistance * h * height;
    if (positions.some(([, other]) => distance(position, other) < room)) continue;
    const common = { node: null, at: position, shape, closed: 0, isWedge: false, height };
    found.push({ ...common, verdict: "not tried", culprit: null });
  }
  return found;
}

/** Returns true if a face at the edge from-to forms an angle below 90° with the base, on its empty side. */
function isWedge(from: Position, to: Position, third: Position, apex: Position, normal: Position): boolean {
  const edge = subtract(to, from);
  const across = (position: Position): Position => {
    const v = subtract(position, from);
    return subtract(v, scale(edge, dot(v, edge) / dot(edge, edge)));
  };
  const toApex = across(apex);
  return dot(across(third), toApex) > 0 && dot(toApex, normal) > 0;
}

/** Returns a frame in which the base lies flat, with its middle at the origin, its normal up, and sizes of about 1. */
export function frameOf({ base }: SpaceStep): {
  readonly to: (position: Position) => Position;
  readonly size: number;
} {
  const origin = mean(base);
  const normal = cross(subtract(base[1], base[0]), subtract(base[2], base[0]));
  const up = scale(normal, 1 / length(normal));
  const along = subtract(base[1], base[0]);
  const right = scale(along, 1 / length(along));
  const ahead = cross(up, right);
  const size = length(along);
  return {
    size,
    to: (position) => {
      const v = scale(subtract(position, origin), 1 / size);
      return [dot(v, right), dot(v, ahead), dot(v, up)];
    },
  };
}
