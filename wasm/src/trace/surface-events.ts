/**
 * Reads the events of lines and patches, with the numbers as they are in the file: relative ones stay relative. The
 * cursor is behind the event's first byte.
 */
import {
  CARRIERS_BIT,
  CURVED_BIT,
  EDGE_REFUSALS,
  NO_NEXT_PASS,
  type EdgeRefusal,
  NEW_NODE_BIT,
  PASSES,
  REPEATED_BIT,
  SAME_SAMPLE_BIT,
  STATION_ENDS,
  type StationEnd,
} from "./layout.js";
import type { TraceCursor } from "./trace-cursor.js";

/** x y in the plane of a patch. */
export type Pair = readonly [number, number];
/** x y z in space, or the three different entries of a symmetric 2 x 2 matrix. */
export type Triple = readonly [number, number, number];

export interface StationEvent {
  readonly end: StationEnd;
  /** Parameter of the line, 0 to 1. */
  readonly parameter: number;
  /** Target size where the side begins. */
  readonly start: number;
  readonly length: number;
  readonly rounds: number;
  /** Length of the line up to the station, in target sizes. */
  readonly sides: number;
  /** Position of the station minus that of the line's first end. */
  readonly offset: Triple;
}

export function readStation(cursor: TraceCursor, detail: number): StationEvent {
  const end = STATION_ENDS[detail];
  if (end === undefined)
    return cursor.fail(`there is no end ${detail} of a step along a line`, cursor.at - 1);
  return {
    end,
    parameter: cursor.float(),
    start: cursor.float(),
    length: cursor.float(),
    rounds: cursor.varint(),
    sides: cursor.float(),
    offset: [cursor.float(), cursor.float(), cursor.float()],
  };
}

export interface DividedEvent {
  /** Length of the line in target sizes. */
  readonly length: number;
  /** x y z per node, both ends included; empty if the line cannot be divided. */
  readonly nodes: Float64Array;
}

export function readDivided(cursor: TraceCursor): DividedEvent {
  return { length: cursor.double(), nodes: readPositions(cursor, cursor.count("nodes", 24)) };
}

export interface HalvedEvent {
  readonly line: number;
  readonly side: number;
  readonly position: Triple;
}

export function readHalved(cursor: TraceCursor): HalvedEvent {
  return {
    line: cursor.varint(),
    side: cursor.varint(),
    position: [cursor.double(), cursor.double(), cursor.double()],
  };
}

export interface NumberedLine {
  readonly line: number;
  readonly first: number;
  readonly last: number;
  /** The first inner node; the others follow it. */
  readonly inner: number;
}

export interface NumberedEvent {
  readonly nodeCount: number;
  readonly lines: readonly NumberedLine[];
}

export function readNumbered(cursor: TraceCursor): NumberedEvent {
  const count = cursor.count("lines", 4);
  const nodeCount = cursor.varint();
  const lines: NumberedLine[] = [];
  let line = 0;
  for (let i = 0; i < count; i++) {
    line += cursor.varint();
    lines.push({ line, first: cursor.varint(), last: cursor.varint(), inner: cursor.varint() });
  }
  return { nodeCount, lines };
}

export interface PatchEvent {
  readonly patch: number;
  readonly isCurved: boolean;
  readonly isRepeated: boolean;
  /** x y per node of the boundary, in the plane. */
  readonly plane: Float64Array;
  /** Index in the surface, per node. */
  readonly surfaceNodes: Uint32Array;
  /** Two per node: 0, or the number plus one of a straight line of the plane. */
  readonly carriers: Uint32Array;
  /** x y z per node of a seam. */
  readonly seam: Float64Array;
  /** First and second node per edge of the boundary. */
  readonly edges: Uint32Array;
}

export function readPatch(cursor: TraceCursor, detail: number): PatchEvent {
  const patch = cursor.varint();
  const count = cursor.count("nodes", 17);
  const seam = readPositions(cursor, cursor.count("nodes of a seam", 24));
  const plane = new Float64Array(2 * count);
  const surfaceNodes = new Uint32Array(count);
  let node = 0;
  for (let i = 0; i < count; i++) {
    plane[2 * i] = cursor.double();
    plane[2 * i + 1] = cursor.double();
    surfaceNodes[i] = node += cursor.zigzag();
  }
  const carriers = new Uint32Array(2 * count);
  if ((detail & CARRIERS_BIT) !== 0) for (let i = 0; i < 2 * count; i++) carriers[i] = cursor.varint();
  const isCurved = (detail & CURVED_BIT) !== 0;
  const isRepeated = (detail & REPEATED_BIT) !== 0;
  return { patch, isCurved, isRepeated, plane, surfaceNodes, carriers, seam, edges: readEdges(cursor) };
}

function readEdges(cursor: TraceCursor): Uint32Array {
  const edges = new Uint32Array(2 * cursor.count("edges", 2));
  let node = 0;
  for (let i = 0; i < edges.length; i++) edges[i] = node += cursor.zigzag();
  return edges;
}

/** Size and metric near a base edge. */
export interface PlaneSample {
  /** Target edge length in space. */
  readonly size: number;
  /** A step d of the plane is sqrt(d . G d) target sizes long in space: G as xx, xy, yy. */
  readonly metric: Triple;
}

export interface BaseEdgeEvent {
  /** Number of failed attempts to complete the edge. */
  readonly pass: number;
  /** Number of the edge minus that of the base edge before it. */
  readonly edge: number;
  /** Minus that of the base edge before it. */
  readonly sizeClass: number;
  readonly layer: number;
  /** Undefined: that of the base edge before it. */
  readonly sample: PlaneSample | undefined;
  readonly nearbyEdges: number;
  readonly rankedCandidates: number;
}

export function readBaseEdge(cursor: TraceCursor, detail: number): BaseEdgeEvent {
  const pass = detail % SAME_SAMPLE_BIT;
  if (pass >= PASSES || detail >= 2 * SAME_SAMPLE_BIT)
    cursor.fail(`there is no pass ${detail}`, cursor.at - 1);
  const isSame = (detail & SAME_SAMPLE_BIT) !== 0;
  return {
    pass,
    edge: cursor.zigzag(),
    sizeClass: cursor.zigzag(),
    layer: cursor.varint(),
    sample: isSame ? undefined : readSample(cursor),
    nearbyEdges: cursor.varint(),
    rankedCandidates: cursor.varint(),
  };
}

const readSample = (cursor: TraceCursor): PlaneSample => ({
  size: cursor.shorterFloat(),
  metric: [cursor.shorterFloat(), cursor.shorterFloat(), cursor.shorterFloat()],
});

export interface RefusedEdgeEvent {
  readonly reason: EdgeRefusal;
  /** Number minus that of the base edge's first node; undefined for a new node. */
  readonly node: number | undefined;
  /** Number of an edge minus that of the base edge, if the reason has one. */
  readonly culprit: number | undefined;
}

export function readRefusedEdge(cursor: TraceCursor, detail: number): RefusedEdgeEvent {
  const isNew = (detail & NEW_NODE_BIT) !== 0;
  const reason = EDGE_REFUSALS[detail % NEW_NODE_BIT];
  if (reason === undefined) return cursor.fail(`there is no reason ${detail} for a refusal`, cursor.at - 1);
  const hasCulprit = reason === "crosses" || reason === "too-close";
  return {
    reason,
    node: isNew ? undefined : cursor.zigzag(),
    culprit: hasCulprit ? cursor.zigzag() : undefined,
  };
}

/** The ideal point in the plane: exact if it gives the position of a new node, else minus the base edge's first node. */
export interface IdealEvent {
  readonly isExact: boolean;
  readonly ideal: Pair;
}

export interface AcceptedEdgeEvent extends IdealEvent {
  /** Number minus that of the base edge's first node; undefined for a new node. */
  readonly node: number | undefined;
  /** Position of a new node minus that of the base edge's first node. */
  readonly offset: Triple | undefined;
  /**
   * For the edges to the apex and from it: whether an edge of the front is closed, or one joins; and its number minus
   * that of the base edge.
   */
  readonly edges: readonly { readonly isClosed: boolean; readonly edge: number }[];
}

export function readAcceptedEdge(cursor: TraceCursor, detail: number): AcceptedEdgeEvent {
  const isNew = (detail & NEW_NODE_BIT) !== 0;
  if (detail % NEW_NODE_BIT > 3) cursor.fail("the detail of an accepted candidate is wrong", cursor.at - 1);
  return {
    node: isNew ? undefined : cursor.zigzag(),
    isExact: isNew,
    ideal: isNew ? [cursor.double(), cursor.double()] : readOffset(cursor),
    offset: isNew ? [cursor.shorterFloat(), cursor.shorterFloat(), cursor.shorterFloat()] : undefined,
    edges: [1, 2].map((bit) => ({ isClosed: (detail & bit) !== 0, edge: cursor.zigzag() })),
  };
}

export interface PostponedEdgeEvent extends IdealEvent {
  /** Pass in which the edge comes again; null if it is not tried again. */
  readonly nextPass: number | null;
}

export function readPostponedEdge(cursor: TraceCursor, detail: number): PostponedEdgeEvent {
  if (detail >= PASSES && detail !== NO_NEXT_PASS) cursor.fail(`there is no pass ${detail}`, cursor.at - 1);
  const nextPass = detail === NO_NEXT_PASS ? null : detail;
  return { nextPass, isExact: false, ideal: readOffset(cursor) };
}

const readOffset = (cursor: TraceCursor): Pair => [cursor.float(), cursor.float()];

/** Returns the hash of a front's triangles: 16 hexadecimal digits. */
export function readHash(cursor: TraceCursor): string {
  const bytes = [...cursor.bytes(8)].reverse();
  return bytes.map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

export interface ImprovedEvent {
  /** x y per interior node. */
  readonly interior: Float64Array;
  /** Three nodes per triangle. */
  readonly triangles: Uint32Array;
}

export function readImproved(cursor: TraceCursor): ImprovedEvent {
  const interior = new Float64Array(2 * cursor.count("nodes", 6));
  for (let i = 0; i < interior.length; i++) interior[i] = cursor.shorterFloat();
  const triangles = new Uint32Array(3 * cursor.count("triangles", 3));
  let node = 0;
  for (let i = 0; i < triangles.length; i++) triangles[i] = node += cursor.zigzag();
  return { interior, triangles };
}

function readPositions(cursor: TraceCursor, count: number): Float64Array {
  return Float64Array.from({ length: 3 * count }, () => cursor.double());
}
