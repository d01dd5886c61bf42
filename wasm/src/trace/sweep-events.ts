/** Reads the sweeps of the optimizer at the end of a trace, one event each (docs/TRACE.md). */
import type { Steps } from "../base/steps.js";
import { PAUSE } from "../base/steps.js";
import { EVENT, KIND_BITS, SWEEP_GEOMETRY_BIT, SWEEP_KINDS, SWEEP_RESTORED } from "./layout.js";
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

/** What the sweeps of the optimizer have come to. */
export interface OptimizationSummary {
  /** The mesh of the front, before the first sweep. */
  readonly before: SweepMeasures;
  /** The sweeps, in their order. */
  readonly sweeps: readonly TracedSweep[];
  /**
   * Number of the sweep whose mesh is the result, from 1; 0 for the mesh before. Regions are optimized one after the other, and
   * the sweeps of a region after its best mesh are discarded: it is the last sweep that was not.
   */
  readonly result: number;
}

/** What the events of the optimizer say. */
export interface SweepEvents {
  readonly summary: OptimizationSummary;
  /** Where the geometry of the first mesh and of each sweep begins in the file; empty if it was not recorded. */
  readonly offsets: readonly number[];
  /** Per sweep, number of the one whose mesh it has changed: the one before it, unless an earlier mesh of its region was restored. */
  readonly changed: readonly number[];
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
  let known = { nodes: boundaryNodes, slots: 0 };
  const knownAfter: (typeof known)[] = [];
  const offsets: number[] = [];
  const geometryBit = (cursor.peek() >> KIND_BITS) & SWEEP_GEOMETRY_BIT;
  // The byte of an event without its kind and the bit for its geometry; that kind and bit must be right.
  const detail = (): number => {
    const first = cursor.byte() - EVENT.sweep;
    const rest = (first >> KIND_BITS) - geometryBit;
    if (first >> KIND_BITS === SWEEP_RESTORED) return SWEEP_RESTORED;
    return first % (1 << KIND_BITS) === 0 && rest < SWEEP_RESTORED ? rest : fail(cursor);
  };
  const readGeometry = (hasMoves: boolean): void => {
    if (geometryBit === 0) return;
    offsets.push(cursor.at);
    known = check(readSweepGeometry(cursor, hasMoves), known, cursor);
    knownAfter.push(known);
  };
  if (detail() !== 0) fail(cursor);
  const before = readMeasures(cursor);
  readGeometry(false);
  const sweeps: TracedSweep[] = [];
  const changed: number[] = [];
  let result = 0;
  while (cursor.ahead > 0) {
    yield PAUSE;
    const next = detail();
    if (next === SWEEP_RESTORED) {
      result = cursor.varint();
      if (result > sweeps.length) fail(cursor);
      known = knownAfter[result] ?? known;
      continue;
    }
    const kind = SWEEP_KINDS[next - 1] ?? fail(cursor);
    const movedNodes = cursor.varint();
    const addedNodes = cursor.varint();
    const removedNodes = cursor.varint();
    const changedElements = cursor.varint();
    sweeps.push({ kind, movedNodes, addedNodes, removedNodes, changedElements, ...readMeasures(cursor) });
    readGeometry(true);
    changed.push(result);
    result = sweeps.length;
  }
  return { summary: { before, sweeps, result }, offsets, changed };
}

function fail(cursor: TraceCursor): never {
  return cursor.fail("this is no sweep of the optimizer", cursor.at - 1);
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

/** Checks that the geometry names only what exists, and returns the numbers of nodes and slots with what it makes. */
function check(
  { movedNodes, newNodes, removedElements, elements, corners }: SweepGeometry,
  known: { readonly nodes: number; readonly slots: number },
  cursor: TraceCursor,
): { nodes: number; slots: number } {
  const lastSlot = elements.at(-1) ?? -1;
  const isKnown = (movedNodes.at(-1) ?? 0) < known.nodes && (removedElements.at(-1) ?? -1) < known.slots;
  const nodes = known.nodes + newNodes.length / 3;
  // Slots are used one after the other.
  const hasSlots = lastSlot < known.slots + elements.length;
  const hasNodes = corners.every((node, i) => i % 5 === 4 || (node >= 0 && node < nodes));
  if (!isKnown || !hasSlots || !hasNodes) fail(cursor);
  return { nodes, slots: Math.max(known.slots, lastSlot + 1) };
}
