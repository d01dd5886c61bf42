/** Reads the sweeps of the optimizer at the end of a trace, one event each (docs/TRACE.md). */
import type { Steps } from "../base/steps.js";
import { PAUSE } from "../base/steps.js";
import { EVENT, KIND_BITS, NEVER, SWEEP_GEOMETRY_BIT, SWEEP_KINDS, SWEEP_RESTORED } from "./layout.js";
import type { SweepKind } from "./layout.js";
import type { TraceCursor } from "./trace-cursor.js";

/** The mesh after a sweep, or before the first one, in numbers. Angles and ratios are those in the metric of the size field. */
export interface SweepMeasures {
  /** Nodes, those of the boundary included. */
  readonly nodes: number;
  readonly tetrahedra: number;
  /** Smallest and largest dihedral angle in degrees. */
  readonly dihedral: { readonly min: number; readonly max: number };
  /** Mean of three times the radius of the inner sphere, divided by that of the outer one; 1 if all elements are regular. */
  readonly meanRadiusRatio: number;
  /** Elements with a dihedral angle below 30 or above 135 degrees. */
  readonly outOfRange: number;
}

/** A sweep of the optimizer over the mesh: what it has changed, and what it has led to. */
export interface TracedSweep extends SweepMeasures {
  readonly kind: SweepKind;
  readonly movedNodes: number;
  readonly addedNodes: number;
  readonly removedNodes: number;
  /** Elements that were made or replaced. */
  readonly changedElements: number;
}

/** What the events of the optimizer say; offsets of the geometry in the file, if it was recorded. */
export interface SweepEvents {
  readonly before: SweepMeasures;
  readonly sweeps: readonly TracedSweep[];
  /** Number of the sweep whose mesh is the result: the last one, unless an earlier mesh was better; 0 for that before. */
  readonly result: number;
  /** Of the first mesh, and of each sweep; empty without geometry. */
  readonly offsets: readonly number[];
}

/** What a sweep does to the mesh; the first one makes it. The numbers of elements are those of slots, which are reused. */
export interface SweepGeometry {
  readonly movedNodes: readonly number[];
  /** x y z per moved node. */
  readonly moves: readonly number[];
  /** x y z per new node. */
  readonly newNodes: readonly number[];
  readonly removedElements: readonly number[];
  readonly elements: readonly number[];
  /** Four nodes and the region per element. */
  readonly corners: readonly number[];
}

/** Reads all sweeps; null if the optimizer has not begun. The cursor is behind the end of the last front. */
export function* readSweeps(cursor: TraceCursor, boundaryNodes: number): Steps<SweepEvents | null> {
  if (cursor.ahead === 0) return null;
  const offsets: number[] = [];
  const checker = new GeometryChecker(cursor, boundaryNodes);
  const start = readHead(cursor);
  if (start.detail !== 0) cursor.fail("the optimization does not begin with a mesh", cursor.at - 1);
  const before = readMeasures(cursor);
  const readGeometry = (hasMoves: boolean): void => {
    offsets.push(cursor.at);
    checker.check(readSweepGeometry(cursor, hasMoves));
  };
  if (start.hasGeometry) readGeometry(false);
  const sweeps: TracedSweep[] = [];
  let result: number | undefined;
  while (cursor.ahead > 0) {
    yield PAUSE;
    const { detail, hasGeometry } = readHead(cursor);
    if (result !== undefined) cursor.fail("a sweep follows the restored mesh", cursor.at - 1);
    if (detail === SWEEP_RESTORED) {
      result = cursor.varint();
      if (result > sweeps.length) cursor.fail(`there is no sweep ${result}`);
      continue;
    }
    const kind = SWEEP_KINDS[detail - 1];
    if (kind === undefined) return cursor.fail(`there is no sweep of kind ${detail}`, cursor.at - 1);
    if (hasGeometry !== start.hasGeometry) cursor.fail("the mesh of a sweep is missing", cursor.at - 1);
    const changes = {
      movedNodes: cursor.varint(),
      addedNodes: cursor.varint(),
      removedNodes: cursor.varint(),
      changedElements: cursor.varint(),
    };
    sweeps.push({ kind, ...changes, ...readMeasures(cursor) });
    if (hasGeometry) readGeometry(true);
  }
  return { before, sweeps, result: result ?? sweeps.length, offsets };
}

function readHead(cursor: TraceCursor): { readonly detail: number; readonly hasGeometry: boolean } {
  const first = cursor.byte();
  if (first % (1 << KIND_BITS) !== EVENT.sweep)
    cursor.fail("expected a sweep of the optimizer", cursor.at - 1);
  const detail = first >> KIND_BITS;
  return { detail: detail % SWEEP_GEOMETRY_BIT, hasGeometry: (detail & SWEEP_GEOMETRY_BIT) !== 0 };
}

function readMeasures(cursor: TraceCursor): SweepMeasures {
  const [nodes, tetrahedra] = [cursor.varint(), cursor.varint()];
  const [min, max] = [degreesOf(cursor.float()), degreesOf(cursor.float())];
  return {
    nodes,
    tetrahedra,
    dihedral: { min, max },
    meanRadiusRatio: cursor.float(),
    outOfRange: cursor.varint(),
  };
}

const degreesOf = (cosine: number): number => (Math.acos(Math.max(-1, Math.min(1, cosine))) * 180) / Math.PI;

/** Reads the geometry of a sweep; that of the first mesh has neither moves nor removed elements. */
export function readSweepGeometry(cursor: TraceCursor, hasMoves: boolean): SweepGeometry {
  const movedNodes = hasMoves ? readIndices(cursor, "nodes") : [];
  const moves = Array.from({ length: 3 * movedNodes.length }, () => cursor.shorterFloat());
  const newNodes = Array.from({ length: 3 * cursor.count("nodes", 24) }, () => cursor.double());
  const removedElements = hasMoves ? readIndices(cursor, "elements") : [];
  const elements = readIndices(cursor, "elements");
  const corners: number[] = [];
  let node = 0;
  for (let i = 0; i < elements.length; i++) {
    for (let k = 0; k < 4; k++) corners.push((node += cursor.zigzag()));
    corners.push(cursor.varint());
  }
  return { movedNodes, moves, newNodes, removedElements, elements, corners };
}

function readIndices(cursor: TraceCursor, what: string): readonly number[] {
  const count = cursor.count(what, 1);
  let last = 0;
  return Array.from({ length: count }, () => (last += cursor.varint()));
}

/** Checks that the geometry names only what exists. */
class GeometryChecker {
  #nodes: number;
  #slots = 0;

  constructor(
    readonly cursor: TraceCursor,
    boundaryNodes: number,
  ) {
    this.#nodes = boundaryNodes;
  }

  check({ movedNodes, newNodes, removedElements, elements, corners }: SweepGeometry): void {
    const last = Math.min(movedNodes.at(-1) ?? 0, NEVER);
    if (last >= this.#nodes) this.cursor.fail(`there is no node ${last} to move`);
    this.#nodes += newNodes.length / 3;
    if ((removedElements.at(-1) ?? -1) >= this.#slots)
      this.cursor.fail("an element is removed that does not exist");
    const highest = elements.at(-1) ?? -1;
    // Slots are used one after the other.
    if (highest >= this.#slots + elements.length)
      this.cursor.fail(`element ${highest} cannot have this number`);
    this.#slots = Math.max(this.#slots, highest + 1);
    for (let i = 0; i < corners.length; i++) {
      const node = corners[i] ?? 0;
      if (i % 5 < 4 && (node < 0 || node >= this.#nodes)) this.cursor.fail(`there is no node ${node}`);
    }
  }
}
