/**
 * What would happen if a candidate were accepted: an independent check in doubles of the engine's verdicts. It follows the
 * paper's observation: two triangles cross only if a side of one crosses the other. What they share is left out.
 */
import type { Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";
import { cross, dot, subtract, boxOf } from "../../document/vectors";
import { alphasOf, excessOf, pointAt, type SideAndFace, type Segment, type Triangle } from "./crossing";

/** How near to a face a side counts as touching it, as a share of their lengths. */
export const touching = 1e-9;

/** The element of a base face and a candidate: positions, and indices of nodes; null for a new node. */
export interface NewElement {
  readonly corners: readonly [Position, Position, Position, Position];
  readonly nodes: readonly [number, number, number, number | null];
}

export function newElement(trace: Trace, face: number, apex: Position, node: number | null): NewElement {
  const [a, b, c] = nodesOf(trace, face);
  return {
    corners: [positionOf(trace, a), positionOf(trace, b), positionOf(trace, c), apex],
    nodes: [a, b, c, node],
  };
}

/** Returns six times the volume; positive if the apex is on the empty side of the base. */
export function sixVolumes([a, b, c, d]: NewElement["corners"]): number {
  return dot(cross(subtract(b, a), subtract(c, a)), subtract(d, a));
}

/** Returns whether the apex is not clearly on the empty side of the base. */
export function isBehind({ corners: [a, b, c, d] }: NewElement): boolean {
  const normal = cross(subtract(b, a), subtract(c, a));
  const arm = subtract(d, a);
  const scale = Math.hypot(...normal) * Math.hypot(...arm);
  return dot(normal, arm) <= touching * scale;
}

/** Returns the faces of the front that an element would cross, those of a state, ascending. O(faces). */
export function crossedFaces(
  trace: Trace,
  state: number,
  element: NewElement,
  tolerance = -touching,
): number[] {
  const { low, high } = boxOf(element.corners.flat());
  const { faces, nodes } = trace;
  const isNear = (face: number): boolean => {
    const a = 3 * (faces.nodes[3 * face] ?? 0);
    const b = 3 * (faces.nodes[3 * face + 1] ?? 0);
    const c = 3 * (faces.nodes[3 * face + 2] ?? 0);
    for (let axis = 0; axis < 3; axis++) {
      // Without arrays, because this is asked for all faces of the front.
      const x = nodes.positions[a + axis] ?? 0;
      const y = nodes.positions[b + axis] ?? 0;
      const z = nodes.positions[c + axis] ?? 0;
      const from = low[axis] ?? 0;
      const to = high[axis] ?? 0;
      if ((x > to && y > to && z > to) || (x < from && y < from && z < from)) return false;
    }
    return true;
  };
  const near = trace.frontAt(state).filter(isNear);
  return Array.from(near).filter((face) => crossesFace(trace, element, face, tolerance));
}

/** Returns whether an element would cross a face: with a positive tolerance also if they only touch. */
export function crossesFace(trace: Trace, element: NewElement, face: number, tolerance: number): boolean {
  const nodes = nodesOf(trace, face);
  const free = nodes.filter((node) => !element.nodes.includes(node));
  if (free.length === 0) return false;
  const shared = element.nodes.map((node) => node !== null && nodes.some((other) => other === node));
  const hasInside = free.some((node) => {
    const weights = weightsOf(element.corners, positionOf(trace, node));
    // A face with a common edge also crosses if its third node is in the wedge of the element at this edge.
    return weights.every((weight, i) => (free.length === 1 && shared[i] === true) || weight >= -tolerance);
  });
  return (
    hasInside || sidesAndFaces(element, frontFace(trace, face)).some(({ excess }) => excess <= tolerance)
  );
}

/** A face of the front: positions, and indices of nodes. */
export interface FrontFace {
  readonly corners: Triangle;
  readonly nodes: readonly [number, number, number];
}

export function frontFace(trace: Trace, face: number): FrontFace {
  return { corners: cornersOf(trace, face), nodes: nodesOf(trace, face) };
}

/**
 * Returns all pairs of a side and a face without a common node, of an element and a face of the front; the one that crosses
 * most clearly first.
 */
export function sidesAndFaces(element: NewElement, { corners: positions, nodes }: FrontFace): SideAndFace[] {
  const pairs: SideAndFace[] = [];
  const compare = (
    isNewSide: boolean,
    side: Segment,
    triangle: Triangle,
    ends: SideAndFace["ends"],
    others: readonly (number | null)[],
  ): void => {
    if (ends.some((end) => end !== null && others.includes(end))) return;
    const alphas = alphasOf(side, triangle);
    if (!alphas) return;
    const point = pointAt(side, alphas[2]);
    pairs.push({ isNewSide, side, ends, face: triangle, alphas, excess: excessOf(alphas), point });
  };
  for (const [i, j] of elementSides) {
    const side = segmentOf(element.corners, i, j);
    compare(true, side, positions, [element.nodes[i], element.nodes[j]], nodes);
  }
  for (const k of [0, 1, 2]) {
    const next = (k + 1) % 3;
    for (const corners of elementFaces) {
      const others = corners.map((corner) => element.nodes[corner] ?? null);
      const side = segmentOf(positions, k, next);
      compare(
        false,
        side,
        triangleOf(element.corners, corners),
        [nodes[k] ?? null, nodes[next] ?? null],
        others,
      );
    }
  }
  return pairs.sort((a, b) => a.excess - b.excess);
}

/** How the front changes with an element. */
export interface FrontChange {
  /** Faces that leave the front: the base, and those that the element closes; ascending. */
  readonly left: readonly number[];
  /** Corners of the faces that join it. */
  readonly joined: readonly Triangle[];
}

/**
 * Returns how the front of a state would change if an element were made over a face. A face of the front is closed by the element
 * only if its empty side is that of the element: at a dangling sheet, two faces of the front have the same nodes. O(faces).
 */
export function frontChange(trace: Trace, state: number, face: number, element: NewElement): FrontChange {
  const [a, b, c] = element.corners;
  const apex = element.corners[3];
  const apexNode = element.nodes[3];
  // Of a new node there are no faces yet. Without arrays, because this is asked for all faces of the front.
  const { nodes: corners } = trace.faces;
  const hasApex = (other: number): boolean =>
    corners[3 * other] === apexNode ||
    corners[3 * other + 1] === apexNode ||
    corners[3 * other + 2] === apexNode;
  const atApex = apexNode === null ? [] : Array.from(trace.frontAt(state).filter(hasApex));
  const sides = [
    { from: element.nodes[0], to: element.nodes[1], corners: [a, b, apex] },
    { from: element.nodes[1], to: element.nodes[2], corners: [b, c, apex] },
    { from: element.nodes[2], to: element.nodes[0], corners: [c, a, apex] },
  ] as const;
  const left = [face];
  const joined: Triangle[] = [];
  for (const { from, to, corners: positions } of sides) {
    const closed = atApex.find((other) => {
      const nodes = nodesOf(trace, other);
      return nodes.some((node, i) => node === to && nodes[(i + 1) % 3] === from);
    });
    if (closed === undefined) joined.push(positions);
    else left.push(closed);
  }
  return { left: left.sort((one, other) => one - other), joined };
}

/** The apex is corner 3. */
const elementSides = [
  [0, 3],
  [1, 3],
  [2, 3],
  [0, 1],
  [1, 2],
  [2, 0],
] as const;
const elementFaces = [
  [1, 2, 3],
  [2, 0, 3],
  [0, 1, 3],
  [0, 1, 2],
] as const;

const none: Position = [0, 0, 0];

function segmentOf(positions: readonly Position[], i: number, j: number): Segment {
  return [positions[i] ?? none, positions[j] ?? none];
}

function triangleOf(positions: readonly Position[], [i, j, k]: readonly [number, number, number]): Triangle {
  return [positions[i] ?? none, positions[j] ?? none, positions[k] ?? none];
}

/** Returns the barycentric coordinates of a position in a tetrahedron: the shape functions of its corners. */
export function weightsOf(corners: NewElement["corners"], position: Position): readonly number[] {
  const whole = sixVolumes(corners);
  return corners.map((_, i) => {
    const [a, b, c, d] = corners.map((corner, k) => (k === i ? position : corner));
    return a && b && c && d ? sixVolumes([a, b, c, d]) / whole : 0;
  });
}

export function nodesOf({ faces }: Trace, face: number): readonly [number, number, number] {
  const [a = 0, b = 0, c = 0] = faces.nodes.subarray(3 * face, 3 * face + 3);
  return [a, b, c];
}

export function positionOf({ nodes }: Trace, node: number): Position {
  const [x = 0, y = 0, z = 0] = nodes.positions.subarray(3 * node, 3 * node + 3);
  return [x, y, z];
}

/** Returns the corners of a face. */
export function cornersOf(trace: Trace, face: number): Triangle {
  const [a, b, c] = nodesOf(trace, face);
  return [positionOf(trace, a), positionOf(trace, b), positionOf(trace, c)];
}
