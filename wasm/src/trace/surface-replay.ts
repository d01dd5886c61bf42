/** Replays the events of lines and patches once, up to the first event of the volume, and checks every event. */
import { PAUSE, type Steps } from "../base/steps.js";
import { GrowingArray } from "./growing-array.js";
import {
  EDGE_REFUSALS,
  EVENTS_PER_SLICE,
  NONE,
  PLANAR_ENDS,
  SURFACE_EVENT,
  SURFACE_KIND_BITS,
} from "./layout.js";
import { PlanarFrontColumns } from "./planar-front-columns.js";
import {
  type AcceptedEdgeEvent,
  type BaseEdgeEvent,
  type PatchEvent,
  type PlaneSample,
  readAcceptedEdge,
  readBaseEdge,
  readDivided,
  readHalved,
  readHash,
  readImproved,
  readNumbered,
  readPatch,
  readPostponedEdge,
  readRefusedEdge,
  readStation,
  type RefusedEdgeEvent,
} from "./surface-events.js";
import type { PlanarFront, TracedDivision } from "./surface-steps.js";
import { ACCEPTED } from "./trace-columns.js";
import type { TraceCursor } from "./trace-cursor.js";

/** Kinds of steps, by their number in `SurfaceColumns.kinds`. */
export const SURFACE_STEPS = [
  "station",
  "divided",
  "halved",
  "patch",
  "accepted",
  "postponed",
  "improved",
] as const;
type SurfaceStepKind = (typeof SURFACE_STEPS)[number];

/** Per step, from 1; entry 0 is unused. */
export interface SurfaceColumns {
  /** Offset of the step's event in the file. */
  readonly offsets: Uint32Array;
  /** Index in SURFACE_STEPS. */
  readonly kinds: Uint8Array;
  /** Index of the division or of the planar front; NONE for a halving. */
  readonly owners: Uint32Array;
  /** Index of the base edge; NONE for other steps. */
  readonly bases: Uint32Array;
  /** Number of edges of the planar front after the step; of stations of the line, in the line's steps. */
  readonly sizes: Uint32Array;
  /** Index in the samples; of base edges. */
  readonly samples: Uint32Array;
  readonly sizeClasses: Uint32Array;
  /** The candidates of step k are those from `firstCandidates[k]` to `firstCandidates[k + 1]`. */
  readonly firstCandidates: Uint32Array;
  /** Number of the node in its patch; NONE for a new node that was refused. */
  readonly candidateNodes: Uint32Array;
  /** Index of an edge, or NONE. */
  readonly candidateCulprits: Uint32Array;
  /** Index in EDGE_REFUSALS, or ACCEPTED. */
  readonly candidateVerdicts: Uint8Array;
}

export interface ReplayedSurface {
  readonly divisions: readonly TracedDivision[];
  readonly fronts: readonly PlanarFront[];
  readonly columns: SurfaceColumns;
  readonly samples: readonly PlaneSample[];
  /** Number of the nodes of all lines, which come first in the surface. */
  readonly lineNodes: number;
}

/** A line whose division is being read. */
interface OpenLine {
  readonly line: number;
  readonly begin: readonly [number, number, number];
  readonly firstStep: number;
  readonly stations: number[];
}

interface OpenBase {
  /** The engine's number of the edge. */
  readonly number: number;
  /** Number of new nodes refused so far. */
  newNodes: number;
}

/** The second height at which a new node is tried, of that of the ideal point. */
const LOWER_HEIGHT = 0.6;

export class SurfaceReplay {
  readonly #cursor: TraceCursor;
  readonly #divisions: TracedDivision[] = [];
  readonly #fronts: PlanarFront[] = [];
  readonly #samples: PlaneSample[] = [];
  /** Per line: x y z of its nodes at present. */
  readonly #nodesOf = new Map<number, number[]>();
  #linePositions = new Float64Array();
  #line: OpenLine | undefined;
  #patch: PlanarFrontColumns | undefined;
  #hasEnded = false;
  #eventOffset = 0;
  /** The base edge that waits for its outcome. */
  #base: OpenBase | undefined;
  readonly #offsets = new GrowingArray(Uint32Array);
  readonly #kinds = new GrowingArray(Uint8Array);
  readonly #owners = new GrowingArray(Uint32Array);
  readonly #bases = new GrowingArray(Uint32Array);
  readonly #sizes = new GrowingArray(Uint32Array);
  readonly #sampleOf = new GrowingArray(Uint32Array);
  readonly #sizeClasses = new GrowingArray(Uint32Array);
  readonly #firstCandidates = new GrowingArray(Uint32Array);
  readonly #candidateNodes = new GrowingArray(Uint32Array);
  readonly #candidateCulprits = new GrowingArray(Uint32Array);
  readonly #candidateVerdicts = new GrowingArray(Uint8Array);

  /** The cursor is at the first event of the trace. */
  constructor(cursor: TraceCursor) {
    this.#cursor = cursor;
    this.#begin(NONE, NONE);
    this.#end("station", 0);
  }

  /** Reads all events of lines and patches. */
  *readEvents(): Steps<ReplayedSurface> {
    for (let events = 1; this.#next(); events++) if (events % EVENTS_PER_SLICE === 0) yield PAUSE;
    if (this.#line !== undefined || this.#patch !== undefined) this.#fail("a line or a patch has no end");
    this.#firstCandidates.push(this.#candidateNodes.length);
    return {
      divisions: this.#divisions,
      fronts: this.#fronts,
      samples: this.#samples,
      lineNodes: this.#linePositions.length / 3,
      columns: {
        offsets: this.#offsets.copy(),
        kinds: this.#kinds.copy(),
        owners: this.#owners.copy(),
        bases: this.#bases.copy(),
        sizes: this.#sizes.copy(),
        samples: this.#sampleOf.copy(),
        sizeClasses: this.#sizeClasses.copy(),
        firstCandidates: this.#firstCandidates.copy(),
        candidateNodes: this.#candidateNodes.copy(),
        candidateCulprits: this.#candidateCulprits.copy(),
        candidateVerdicts: this.#candidateVerdicts.copy(),
      },
    };
  }

  /** Reads the next event; returns false, and reads nothing, at the first event of the volume. */
  #next(): boolean {
    const cursor = this.#cursor;
    if (cursor.ahead === 0) cursor.fail("the file ends before the trace does");
    this.#eventOffset = cursor.at;
    const first = cursor.byte();
    const kind = first & ((1 << SURFACE_KIND_BITS) - 1);
    const detail = first >> SURFACE_KIND_BITS;
    const { line, halved, numbered, patch } = SURFACE_EVENT;
    const mayFollow: readonly number[] = [0, line, halved, numbered, patch];
    // The triangulation of the patch was not improved.
    if (this.#hasEnded && mayFollow.includes(kind)) this.#endPatch();
    if (kind === 0) {
      cursor.at = this.#eventOffset;
      return false;
    }
    this.#checkOrder(kind);
    switch (kind) {
      case SURFACE_EVENT.line:
        this.#beginLine();
        break;
      case SURFACE_EVENT.station:
        this.#addStation(detail);
        break;
      case SURFACE_EVENT.divided:
        this.#divide();
        break;
      case SURFACE_EVENT.halved:
        this.#halve();
        break;
      case SURFACE_EVENT.numbered:
        this.#number();
        break;
      case SURFACE_EVENT.patch:
        this.#beginPatch(readPatch(cursor, detail));
        break;
      case SURFACE_EVENT.base:
        this.#beginStep(readBaseEdge(cursor, detail));
        break;
      case SURFACE_EVENT.refused:
        this.#refuse(readRefusedEdge(cursor, detail));
        break;
      case SURFACE_EVENT.accepted:
        this.#accept(readAcceptedEdge(cursor, detail));
        break;
      case SURFACE_EVENT.postponed:
        readPostponedEdge(cursor, detail);
        this.#postpone();
        break;
      case SURFACE_EVENT.ended:
        this.#endFront(detail);
        break;
      case SURFACE_EVENT.improved:
        this.#improve();
        break;
      default:
        this.#fail(`there is no event of kind ${kind}`);
    }
    return true;
  }

  /** Checks that an event of this kind may follow those before. */
  #checkOrder(kind: number): void {
    const { line, station, divided, halved, numbered, patch, base, ended, improved } = SURFACE_EVENT;
    const isVerdict = kind > base && kind < ended;
    if (isVerdict !== (this.#base !== undefined))
      this.#fail(isVerdict ? "a verdict has no base edge" : "a base edge has no outcome");
    const isOfLine = kind === station || kind === divided;
    if (isOfLine !== (this.#line !== undefined))
      this.#fail(isOfLine ? "no line has begun" : "a line has no end");
    const isFirst = kind === line || kind === halved || kind === numbered || kind === patch;
    if (isFirst && this.#patch !== undefined) this.#fail("a patch has no end");
    if (!isFirst && !isOfLine && this.#patch === undefined) this.#fail("no patch has begun");
    if ((kind === base || kind === ended) && this.#hasEnded) this.#fail("the front of the patch has ended");
    if (kind === improved && !this.#hasEnded) this.#fail("the front of the patch has not ended");
  }

  #beginLine(): void {
    const line = this.#cursor.varint();
    const begin = [this.#cursor.double(), this.#cursor.double(), this.#cursor.double()] as const;
    this.#line = { line, begin, firstStep: this.#step + 1, stations: [] };
  }

  #addStation(detail: number): void {
    const { offset } = readStation(this.#cursor, detail);
    const { begin, stations } = this.#openLine;
    this.#begin(this.#divisions.length, NONE);
    begin.forEach((coordinate, axis) => stations.push(coordinate + (offset[axis] ?? 0)));
    this.#end("station", stations.length / 3);
  }

  #divide(): void {
    const { line, begin, firstStep, stations } = this.#openLine;
    this.#line = undefined;
    const { length, nodes } = readDivided(this.#cursor);
    this.#begin(this.#divisions.length, NONE);
    const lastStep = this.#step;
    this.#divisions.push({
      line,
      begin,
      firstStep,
      lastStep,
      stations: Float64Array.from(stations),
      nodes,
      length,
    });
    this.#nodesOf.set(line, [...nodes]);
    this.#end("divided", stations.length / 3);
  }

  #halve(): void {
    const { line, side, position } = readHalved(this.#cursor);
    const nodes = this.#nodesOf.get(line) ?? this.#fail(`line ${line} is not divided`);
    if (side + 1 >= nodes.length / 3) this.#fail(`line ${line} has no side ${side}`);
    nodes.splice(3 * side + 3, 0, ...position);
    this.#begin(NONE, NONE);
    this.#end("halved", 0);
  }

  #number(): void {
    const { nodeCount, lines } = readNumbered(this.#cursor);
    if (nodeCount > this.#cursor.ahead) this.#fail(`the file is too short for ${nodeCount} nodes`);
    const positions = new Float64Array(3 * nodeCount);
    for (const { line, first, last, inner } of lines) {
      const nodes = this.#nodesOf.get(line) ?? this.#fail(`line ${line} is not divided`);
      const count = nodes.length / 3;
      for (let i = 0; i < count; i++) {
        const node = i === 0 ? first : i === count - 1 ? last : inner + i - 1;
        if (node >= nodeCount) this.#fail(`there is no node ${node}`);
        positions.set(nodes.slice(3 * i, 3 * i + 3), 3 * node);
      }
    }
    this.#linePositions = positions;
  }

  #beginPatch(event: PatchEvent): void {
    const lineNodes = this.#linePositions.length / 3;
    const positions = new Float64Array(3 * event.surfaceNodes.length);
    event.surfaceNodes.forEach((node, i) => {
      const isOfLine = node < lineNodes;
      const at = isOfLine ? node : node - lineNodes;
      const known = isOfLine ? this.#linePositions : event.seam;
      if (3 * at >= known.length) this.#fail(`there is no node ${node}`);
      positions.set(known.subarray(3 * at, 3 * at + 3), 3 * i);
    });
    this.#begin(this.#fronts.length, NONE);
    const patch = (this.#patch = new PlanarFrontColumns(event, this.#step, positions));
    this.#hasEnded = false;
    for (let i = 0; i < event.edges.length; i += 2) {
      const [from = 0, to = 0] = event.edges.subarray(i, i + 2);
      patch.addEdge(i / 2, this.#node(from), this.#node(to), this.#step);
    }
    this.#end("patch", patch.size);
  }

  #beginStep(event: BaseEdgeEvent): void {
    const patch = this.#front;
    const number = patch.lastBase + event.edge;
    const edge = this.#edge(number);
    patch.lastBase = number;
    patch.lastSizeClass += event.sizeClass;
    if (event.sample !== undefined) this.#samples.push(event.sample);
    else if (this.#samples.length === 0) this.#fail("a base edge has no size");
    this.#base = { number, newNodes: 0 };
    this.#begin(this.#fronts.length, edge);
  }

  #refuse({ reason, node, culprit }: RefusedEdgeEvent): void {
    const { number } = this.#openBase;
    const edge = culprit === undefined ? NONE : this.#edge(number + culprit);
    this.#addCandidate(this.#candidate(node), edge, EDGE_REFUSALS.indexOf(reason));
    if (node === undefined) ++this.#openBase.newNodes;
  }

  #accept({ node, offset, ideal, edges }: AcceptedEdgeEvent): void {
    const { number, newNodes } = this.#openBase;
    const patch = this.#front;
    const [from, to] = patch.ends(this.#edge(number));
    const apex =
      offset === undefined
        ? this.#candidate(node)
        : patch.addNode(
            newNodePosition(patch.plane(from), patch.plane(to), ideal, newNodes),
            patch.position(from).map((coordinate, axis) => coordinate + (offset[axis] ?? 0)),
            this.#step,
          );
    this.#addCandidate(apex, NONE, ACCEPTED);
    patch.addTriangle([from, to, apex], this.#step);
    patch.removeEdge(number, this.#step);
    const ends = [
      [from, apex],
      [apex, to],
    ] as const;
    edges.forEach(({ isClosed, edge }, i) => {
      const [a, b] = ends[i] ?? [0, 0];
      this.#changeEdge(number + edge, isClosed, a, b);
    });
    this.#base = undefined;
    this.#end("accepted", patch.size);
  }

  #changeEdge(number: number, isClosed: boolean, from: number, to: number): void {
    const patch = this.#front;
    if (isClosed) {
      const [a, b] = patch.ends(this.#edge(number));
      if (a !== to || b !== from) this.#fail(`edge ${number} is not the opposite one`);
      patch.removeEdge(number, this.#step);
      return;
    }
    // More numbers than edges ever made cannot be in use.
    if (number < 0 || number > patch.edgeCount || patch.edgeOf(number) !== undefined)
      this.#fail(`edge ${number} joins the front, but cannot have this number`);
    patch.addEdge(number, from, to, this.#step);
  }

  /** An edge that is set aside stays in the front: others must not cross it, and a later triangle may close it. */
  #postpone(): void {
    this.#base = undefined;
    this.#end("postponed", this.#front.size);
  }

  #endFront(detail: number): void {
    const patch = this.#front;
    const end = PLANAR_ENDS[detail] ?? this.#fail(`there is no end ${detail} of a front`);
    const hash = readHash(this.#cursor);
    if (patch.size > 0 && end === "covered")
      this.#fail(`the front of patch ${patch.patch} ends before it is closed`);
    if (patch.hash() !== hash) this.#fail(`the triangles of patch ${patch.patch} are not those recorded`);
    this.#hasEnded = true;
    patch.end = end;
    if (end !== "covered") this.#endPatch();
  }

  #improve(): void {
    const patch = this.#front;
    const { interior, triangles } = readImproved(this.#cursor);
    const nodes = patch.boundaryNodes + interior.length / 2;
    const wrong = triangles.find((node) => node >= nodes);
    if (wrong !== undefined) this.#fail(`there is no node ${wrong}`);
    patch.improve(interior, triangles);
    this.#begin(this.#fronts.length, NONE);
    this.#end("improved", 0);
    this.#endPatch();
  }

  #endPatch(): void {
    this.#fronts.push(this.#front.taken(this.#step));
    this.#patch = undefined;
    this.#hasEnded = false;
  }

  #addCandidate(node: number, culprit: number, verdict: number): void {
    this.#candidateNodes.push(node);
    this.#candidateCulprits.push(culprit);
    this.#candidateVerdicts.push(verdict);
  }

  /** Number of an existing candidate, from the file's; NONE for a new node. */
  #candidate(node: number | undefined): number {
    if (node === undefined) return NONE;
    const [from] = this.#front.ends(this.#edge(this.#openBase.number));
    return this.#node(from + node);
  }

  #begin(owner: number, base: number): void {
    this.#offsets.push(this.#eventOffset);
    this.#owners.push(owner);
    this.#bases.push(base);
    this.#sampleOf.push(Math.max(0, this.#samples.length - 1));
    this.#sizeClasses.push(this.#patch?.lastSizeClass ?? 0);
    this.#firstCandidates.push(this.#candidateNodes.length);
  }

  #end(kind: SurfaceStepKind, size: number): void {
    this.#kinds.push(SURFACE_STEPS.indexOf(kind));
    this.#sizes.push(size);
  }

  /** The step that was begun last; 0 before the first. */
  get #step(): number {
    return this.#offsets.length - 1;
  }

  get #openLine(): OpenLine {
    return this.#line ?? this.#fail("no line has begun");
  }

  get #front(): PlanarFrontColumns {
    return this.#patch ?? this.#fail("no patch has begun");
  }

  get #openBase(): OpenBase {
    return this.#base ?? this.#fail("a verdict has no base edge");
  }

  #node(number: number): number {
    return number >= 0 && number < this.#front.nodeCount ? number : this.#fail(`there is no node ${number}`);
  }

  #edge(number: number): number {
    return this.#front.edgeOf(number) ?? this.#fail(`the front has no edge ${number}`);
  }

  #fail(message: string): never {
    return this.#cursor.fail(message, this.#eventOffset);
  }
}

/**
 * Position of a new node in the plane: m + h (p - m), with the ideal point p, the middle m of the base edge, and h = 1, or
 * 0.6 if that was refused. With the operations of the engine, in their order, all bits agree.
 */
export function newNodePosition(
  [ax, ay]: readonly [number, number],
  [bx, by]: readonly [number, number],
  [x, y]: readonly [number, number],
  refusedBefore: number,
): readonly [number, number] {
  const height = refusedBefore === 0 ? 1 : LOWER_HEIGHT;
  const middleX = ax + 0.5 * (bx - ax);
  const middleY = ay + 0.5 * (by - ay);
  return [middleX + height * (x - middleX), middleY + height * (y - middleY)];
}
