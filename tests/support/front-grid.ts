/**
 * The front of a trace, replayed step by step, with its faces in grids of cells: those near a new element are found without
 * a look at all others. Each face is in one cell, that of its middle, of the finest grid whose cells are at least as large as
 * the face; so it reaches into the cells beside its own at most.
 */
import type { AdvanceStep, Trace } from "tetrafront/trace";
import type { Position } from "../../web/document/position";
import { type Box, boxOf, cross, dot, subtract } from "../../web/document/vectors";
import { cornersOf, crossesFace, nodesOf, touching, type NewElement } from "../../web/teach/player/judge";
import { distanceToFace, idealNumbers, unitAxes } from "../../web/teach/player/unit-space";

/** A grid: faces by the indices of their cell along x, y and z. */
type Cells = Map<number, Set<number>>;

/** Cells along an axis, on either side of 0. Keys of cells are below 2 ** 51, exact in a double. */
const maxCells = 2 ** 16;
const axes = [0, 1, 2] as const;
const none: readonly number[] = [];

export class FrontGrid {
  readonly #trace: Trace;
  readonly #levels = new Map<number, Cells>();
  readonly #faces = new Set<number>();
  #state = 0;

  /** The front begins in state 0. */
  constructor(trace: Trace) {
    this.#trace = trace;
    this.#addFrom(0, trace.steps.facesMade[0] ?? 0);
  }

  get state(): number {
    return this.#state;
  }

  /** The faces of the present state, ascending. */
  get faces(): readonly number[] {
    return [...this.#faces].sort((a, b) => a - b);
  }

  /** Moves on to a state. */
  advance(state: number): void {
    const { facesMade } = this.#trace.steps;
    while (this.#state < state) {
      const step = ++this.#state;
      for (const face of this.#trace.changesAt(step).removedFaces) this.#remove(face);
      this.#addFrom(facesMade[step - 1] ?? 0, facesMade[step] ?? 0);
    }
  }

  /** Returns all faces whose boxes overlap a box. */
  near({ low, high }: Box): readonly number[] {
    const found: number[] = [];
    for (const [level, cells] of this.#levels) {
      const size = 2 ** level;
      const first = (axis: 0 | 1 | 2): number => Math.floor(low[axis] / size) - 1;
      const last = (axis: 0 | 1 | 2): number => Math.floor(high[axis] / size) + 1;
      for (let x = first(0); x <= last(0); x++)
        for (let y = first(1); y <= last(1); y++)
          for (let z = first(2); z <= last(2); z++)
            for (const face of cells.get(keyOf(x, y, z)) ?? none)
              if (this.#overlaps(face, low, high)) found.push(face);
    }
    return found;
  }

  #overlaps(face: number, low: Position, high: Position): boolean {
    const { faces, nodes } = this.#trace;
    const a = 3 * (faces.nodes[3 * face] ?? 0);
    const b = 3 * (faces.nodes[3 * face + 1] ?? 0);
    const c = 3 * (faces.nodes[3 * face + 2] ?? 0);
    for (const axis of axes) {
      // Without arrays, because this is asked for all faces around every element.
      const x = nodes.positions[a + axis] ?? 0;
      const y = nodes.positions[b + axis] ?? 0;
      const z = nodes.positions[c + axis] ?? 0;
      const [from, to] = [low[axis], high[axis]];
      if ((x > to && y > to && z > to) || (x < from && y < from && z < from)) return false;
    }
    return true;
  }

  #addFrom(begin: number, end: number): void {
    for (let face = begin; face < end; face++) {
      const [cells, key] = this.#cellOf(face);
      const cell = cells.get(key);
      if (cell) cell.add(face);
      else cells.set(key, new Set([face]));
      this.#faces.add(face);
    }
  }

  #remove(face: number): void {
    const [cells, key] = this.#cellOf(face);
    const cell = cells.get(key);
    if (!cell?.delete(face)) throw new Error(`face ${face} dies, but is no part of the front`);
    if (cell.size === 0) cells.delete(key);
    this.#faces.delete(face);
  }

  #cellOf(face: number): readonly [Cells, number] {
    const corners = cornersOf(this.#trace, face);
    const low = [0, 1, 2].map((axis) => Math.min(...corners.map((corner) => corner[axis] ?? 0)));
    const high = [0, 1, 2].map((axis) => Math.max(...corners.map((corner) => corner[axis] ?? 0)));
    const extent = Math.max(...high.map((value, axis) => value - (low[axis] ?? 0)));
    const level = Math.ceil(Math.log2(extent));
    const cells = this.#levels.get(level) ?? new Map<number, Set<number>>();
    this.#levels.set(level, cells);
    const [x = 0, y = 0, z = 0] = low.map((value, axis) =>
      Math.floor((value + (high[axis] ?? 0)) / 2 / 2 ** level),
    );
    return [cells, keyOf(x, y, z)];
  }
}

function keyOf(x: number, y: number, z: number): number {
  return ((x + maxCells) * 2 * maxCells + (y + maxCells)) * 2 * maxCells + (z + maxCells);
}

/**
 * Returns the faces of a grid's state that an element would cross, as `crossedFaces` does: that looks at all faces of the
 * front. Most faces near the element are on the far side of the plane of one of its faces, or the element is on one side of
 * theirs; they cannot cross it.
 */
export function crossedNear(trace: Trace, grid: FrontGrid, element: NewElement): number[] {
  const crossed: number[] = [];
  const planes = sides.map(([i, j, k, opposite]) => {
    const plane = planeThrough(element.corners[i], element.corners[j], element.corners[k]);
    return heightAbove(plane, element.corners[opposite]) > 0 ? flipped(plane) : plane;
  });
  for (const face of grid.near(boxOf(element.corners.flat()))) {
    const corners = cornersOf(trace, face);
    const isBeyond = (plane: Plane): boolean =>
      corners.every((corner) => heightAbove(plane, corner) >= -plane.tolerance);
    if (planes.some(isBeyond)) continue;
    const plane = planeThrough(...corners);
    const heights = element.corners.map((corner) => heightAbove(plane, corner));
    if (heights.every((height) => height >= -plane.tolerance)) continue;
    if (heights.every((height) => height <= plane.tolerance)) continue;
    if (crossesFace(trace, element, face, -touching)) crossed.push(face);
  }
  return crossed.sort((a, b) => a - b);
}

/**
 * Returns the faces of a grid's state to which the new node of a step is too close by the rules of its class, of those
 * without a common node with the base face.
 */
export function tooCloseNear(trace: Trace, grid: FrontGrid, step: AdvanceStep, position: Position): number[] {
  const reach = idealNumbers(trace, step).size * distanceToFace(trace, step, position, step.face).least;
  const base = nodesOf(trace, step.face);
  const columns = unitAxes(step);
  const half = axes.map((axis) => reach * Math.hypot(...columns.map((column) => column[axis])));
  const shifted = (sign: 1 | -1): Position => [
    position[0] + sign * (half[0] ?? 0),
    position[1] + sign * (half[1] ?? 0),
    position[2] + sign * (half[2] ?? 0),
  ];
  return grid.near({ low: shifted(-1), high: shifted(1) }).filter((face) => {
    if (nodesOf(trace, face).some((node) => base.includes(node))) return false;
    const { distance, least } = distanceToFace(trace, step, position, face);
    return distance < least * (1 - rounding);
  });
}

/** Relative error of distances in doubles. */
export const rounding = 1e-9;

/** Corners of the faces of an element, and the one opposite. */
const sides = [
  [0, 1, 2, 3],
  [0, 1, 3, 2],
  [0, 2, 3, 1],
  [1, 2, 3, 0],
] as const;

interface Plane {
  readonly through: Position;
  readonly normal: Position;
  /** What counts as touching: far less than the check that follows allows. */
  readonly tolerance: number;
}

function planeThrough(a: Position, b: Position, c: Position): Plane {
  const [first, second] = [subtract(b, a), subtract(c, a)];
  const normal = cross(first, second);
  const extent = Math.max(Math.hypot(...first), Math.hypot(...second));
  return { through: a, normal, tolerance: 0.01 * touching * extent * Math.hypot(...normal) };
}

const flipped = (plane: Plane): Plane => ({
  ...plane,
  normal: [-plane.normal[0], -plane.normal[1], -plane.normal[2]],
});

const heightAbove = ({ normal, through }: Plane, position: Position): number =>
  dot(normal, subtract(position, through));
