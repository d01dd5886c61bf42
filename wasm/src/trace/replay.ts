/**
 * Replays the events of a trace once: engine numbers become indices of things ever made, and every event is checked.
 * The engine's numbers are reused: `faceOf_[number]` is the face that has the number at present.
 */
import { inRanges, PAUSE, type Steps } from "../base/steps.js";
import {
  type AcceptedEvent,
  type BaseEvent,
  type ChangeEvent,
  firstFacesIn,
  readAccepted,
  readBase,
  readChange,
  readPostponed,
  readRefused,
  type ReadScore,
  type RefusedEvent,
} from "./events.js";
import { GrowingArray } from "./growing-array.js";
import { EVENT, EVENTS_PER_SLICE, FRONT_CHANGES, KIND_BITS, NONE, REFUSALS } from "./layout.js";
import { ACCEPTED, NodeColumns, SimplexColumns, StepColumns } from "./trace-columns.js";
import type { TraceCursor } from "./trace-cursor.js";

/** What a step comes to, by its number in `TraceSteps.outcomes`. */
export const OUTCOMES = ["accepted", "postponed", ...FRONT_CHANGES] as const;

/** A front that begins: the one of the trace, or one per pass over regions with common interfaces. */
export interface TracedFront {
  /** State in which its faces join; 0 for the first front. */
  readonly state: number;
  /** Index of its first face. */
  readonly firstFace: number;
  /** Median size of its first faces. */
  readonly typicalSize: number;
}

/** The numbers of the engine in one front. */
interface Pass {
  readonly nodeOf: GrowingArray<Uint32Array>;
  readonly faceOf: GrowingArray<Uint32Array>;
  readonly elementOf: GrowingArray<Uint32Array>;
}

export class Replay {
  readonly nodes = new NodeColumns();
  readonly faces = new SimplexColumns(3);
  readonly elements = new SimplexColumns(4);
  readonly steps = new StepColumns();
  /** Per pass: its list of elements at the end, removed ones included. */
  readonly passes: Pass[] = [];
  readonly fronts: TracedFront[] = [];
  readonly #cursor: TraceCursor;
  readonly #boundaryNodes: number;
  /** Number in its pass of each node ever made. */
  readonly #numberOf = new GrowingArray(Uint32Array);
  /** More numbers than bytes cannot be in use; this bounds the memory for damaged files. */
  readonly #numberLimit: number;
  #frontSize = 0;
  /** True after the event `pass`: the first faces of the front follow. */
  #isFrontDue = false;
  /** True after the end of a front: only another front may follow. */
  #hasEnded = false;
  #eventOffset = 0;
  #lastBase = 0;
  /** The base face that waits for its outcome: its number, face and nodes' numbers. */
  #open: { readonly number: number; readonly face: number; readonly firstNode: number } | undefined;

  /** The cursor is at the positions of the boundary's nodes. */
  constructor(
    cursor: TraceCursor,
    boundaryNodes: number,
    readonly readScore: ReadScore,
  ) {
    this.#cursor = cursor;
    this.#boundaryNodes = boundaryNodes;
    if (24 * boundaryNodes > cursor.ahead) cursor.fail(`the file is too short for ${boundaryNodes} nodes`);
    this.#numberLimit = cursor.ahead;
  }

  /** Reads the positions of the boundary's nodes, to the first event. */
  *readNodes(): Steps<void> {
    const cursor = this.#cursor;
    yield* inRanges(this.#boundaryNodes, (begin, end) => {
      for (let i = begin; i < end; i++) {
        this.#numberOf.push(i);
        this.nodes.add([cursor.double(), cursor.double(), cursor.double()], 0, 0);
      }
    });
    this.steps.begin(cursor.at, NONE);
    this.#endStep(0);
  }

  /** Reads all events of the volume, up to the sweeps of the optimizer. */
  *readEvents(): Steps<void> {
    for (let events = 1; this.#next(); events++) {
      if (this.#isFrontDue) yield* this.#readFirstFaces();
      if (events % EVENTS_PER_SLICE === 0) yield PAUSE;
    }
  }

  /** Reads the next event; returns false at the end. */
  #next(): boolean {
    const cursor = this.#cursor;
    if (cursor.ahead === 0) cursor.fail("the file ends before the trace does");
    this.#eventOffset = cursor.at;
    const first = cursor.byte();
    const kind = first & ((1 << KIND_BITS) - 1);
    const detail = first >> KIND_BITS;
    if (this.#hasEnded && kind !== EVENT.pass) this.#fail("there are bytes after the end of the last front");
    this.#hasEnded = kind === EVENT.end;
    const continuesStep = kind === EVENT.refused || kind === EVENT.accepted || kind === EVENT.postponed;
    if (continuesStep !== (this.#open !== undefined))
      this.#fail(continuesStep ? "a verdict has no base face" : "a base face has no outcome");
    if (kind !== EVENT.pass && kind !== EVENT.end && this.passes.length === 0)
      this.#fail("no front has begun");
    switch (kind) {
      case EVENT.pass:
        this.#beginPass();
        return true;
      case EVENT.base:
        this.#beginStep(readBase(cursor, detail));
        return true;
      case EVENT.refused:
        this.#refuse(readRefused(cursor, detail, this.readScore));
        return true;
      case EVENT.accepted:
        this.#accept(readAccepted(cursor, detail, this.readScore));
        return true;
      case EVENT.postponed:
        readPostponed(cursor, detail);
        this.#open = undefined;
        this.#endStep(1);
        return true;
      case EVENT.change:
        this.#change(readChange(cursor, detail), 2 + detail);
        return true;
      case EVENT.end:
        return cursor.ahead > 0 && cursor.peek() % (1 << KIND_BITS) !== EVENT.sweep;
      default:
        return this.#fail(`there is no event of kind ${kind}`);
    }
  }

  #beginPass(): void {
    const typicalSize = this.#cursor.double();
    if (this.#frontSize > 0) this.#fail("a front begins before the last one is closed");
    const pass: Pass = {
      nodeOf: new GrowingArray(Uint32Array),
      faceOf: new GrowingArray(Uint32Array),
      elementOf: new GrowingArray(Uint32Array),
    };
    this.passes.push(pass);
    for (let i = 0; i < this.#boundaryNodes; i++) pass.nodeOf.push(i);
    this.fronts.push({ state: this.#step, firstFace: this.faces.length, typicalSize });
    this.#isFrontDue = true;
  }

  *#readFirstFaces(): Steps<void> {
    const faces = firstFacesIn(this.#cursor);
    for (let number = 0; ; number++) {
      const face = faces.next();
      if (face.done === true) break;
      this.#addFace(number, face.value.nodes, face.value.region);
      if (number % EVENTS_PER_SLICE === 0) yield PAUSE;
    }
    this.#isFrontDue = false;
    this.steps.addFirstFaces(this.faces.length, this.#frontSize);
    this.#lastBase = 0;
  }

  #beginStep(event: BaseEvent): void {
    const number = this.#lastBase + event.face;
    const face = this.#face(number);
    this.#lastBase = number;
    this.#open = { number, face, firstNode: this.#numberOf.at(this.faces.node(face, 0)) };
    this.steps.begin(this.#eventOffset, face);
  }

  #refuse({ reason, candidate, culprit }: RefusedEvent): void {
    const base = this.#base;
    const node = candidate.isNew ? NONE : this.#node(base.firstNode + candidate.node);
    const face = culprit === undefined ? NONE : this.#face(base.number + culprit);
    this.steps.addCandidate(node, face, REFUSALS.indexOf(reason));
  }

  #accept({ candidate, has, faces }: AcceptedEvent): void {
    const base = this.#base;
    this.#open = undefined;
    const [a = 0, b = 0, c = 0] = [0, 1, 2].map((corner) => this.faces.node(base.face, corner));
    const region = this.faces.region(base.face);
    const apex = candidate.isNew
      ? this.#addNode(candidate.position, 1 + Math.min(...[a, b, c].map((node) => this.nodes.layer(node))))
      : this.#node(base.firstNode + candidate.node);
    this.steps.addCandidate(apex, NONE, ACCEPTED);
    const made = this.#step;
    this.#pass.elementOf.push(this.elements.add([a, b, c, apex], region, made));
    this.#removeFace(base.number);
    const known = has.filter((isKnown) => isKnown).length;
    for (const face of faces.slice(0, known)) this.#removeFace(base.number + face);
    const sides = [
      [b, c, apex],
      [c, a, apex],
      [a, b, apex],
    ].filter((_, corner) => has[corner] === false);
    sides.forEach((nodes, i) => {
      this.#addFaceOf(base.number + (faces[known + i] ?? 0), nodes, region);
    });
    this.#endStep(0);
  }

  #change(event: ChangeEvent, outcome: number): void {
    const { nodeOf, elementOf } = this.#pass;
    this.steps.begin(this.#eventOffset, NONE);
    const step = this.#step;
    const layer = this.#layerBeside(event.leavingFaces);
    if (event.keptNodes < this.#boundaryNodes || event.keptNodes > nodeOf.length)
      this.#fail(`there are no ${event.keptNodes} nodes to keep`);
    for (let i = event.keptNodes; i < nodeOf.length; i++) this.nodes.end(nodeOf.at(i), step);
    nodeOf.resize(event.keptNodes);
    for (let i = 0; i < event.newNodes.length; i += 3) {
      const [x = 0, y = 0, z = 0] = event.newNodes.slice(i, i + 3);
      this.#addNode([x, y, z], layer);
    }
    for (const face of event.leavingFaces) this.#removeFace(face);

    if (event.keptElements > elementOf.length)
      this.#fail(`there are no ${event.keptElements} elements to keep`);
    for (let i = event.keptElements; i < elementOf.length; i++)
      if (this.elements.isAlive(elementOf.at(i))) this.elements.end(elementOf.at(i), step);
    elementOf.resize(event.keptElements);
    for (const number of event.removedElements) this.elements.end(this.#element(number, true), step);
    for (const number of event.restoredElements) this.#restore(number);
    for (let i = 0; i < event.newElements.length; i += 5) {
      const nodes = event.newElements.slice(i, i + 4).map((node) => this.#node(node));
      elementOf.push(this.elements.add(nodes, event.newElements[i + 4] ?? 0, step));
    }
    for (let i = 0; i < event.joiningFaces.length; i += 5) {
      const [number = 0, a = 0, b = 0, c = 0, region = 0] = event.joiningFaces.slice(i, i + 5);
      this.#addFace(number, [a, b, c], region);
    }
    this.#endStep(outcome);
  }

  /** An element that comes back is a new one: each has one time of life. */
  #restore(number: number): void {
    const old = this.#element(number, false);
    const nodes = [0, 1, 2, 3].map((corner) => this.elements.node(old, corner));
    this.#pass.elementOf.set(number, this.elements.add(nodes, this.elements.region(old), this.#step));
  }

  #endStep(outcome: number): void {
    const made = {
      faces: this.faces.length,
      elements: this.elements.length,
      nodes: this.nodes.length,
    };
    this.steps.end(outcome, made, this.#frontSize);
  }

  /** The layer of nodes that a change makes: that of the deepest node of the pocket. */
  #layerBeside(faceNumbers: readonly number[]): number {
    let layer = 0;
    for (const number of faceNumbers) {
      const face = this.#face(number);
      for (let corner = 0; corner < 3; corner++)
        layer = Math.max(layer, this.nodes.layer(this.faces.node(face, corner)));
    }
    return layer;
  }

  get #step(): number {
    return this.steps.count;
  }

  get #pass(): Pass {
    return this.passes.at(-1) ?? this.#fail("no front has begun");
  }

  get #base(): { readonly number: number; readonly face: number; readonly firstNode: number } {
    return this.#open ?? this.#fail("a verdict has no base face");
  }

  #addNode(position: readonly [number, number, number], layer: number): number {
    this.#numberOf.push(this.#pass.nodeOf.length);
    const node = this.nodes.add(position, layer, this.#step);
    this.#pass.nodeOf.push(node);
    return node;
  }

  #addFace(number: number, nodeNumbers: readonly number[], region: number): void {
    this.#addFaceOf(
      number,
      nodeNumbers.map((node) => this.#node(node)),
      region,
    );
  }

  #addFaceOf(number: number, nodes: readonly number[], region: number): void {
    const { faceOf } = this.#pass;
    if (number < 0 || number > this.#numberLimit || this.#isFace(number))
      this.#fail(`face ${number} joins the front, but cannot have this number`);
    if (number >= faceOf.length) faceOf.resize(number + 1, NONE);
    faceOf.set(number, this.faces.add(nodes, region, this.#step));
    ++this.#frontSize;
  }

  #removeFace(number: number): void {
    this.faces.end(this.#face(number), this.#step);
    this.#pass.faceOf.set(number, NONE);
    --this.#frontSize;
  }

  #isFace(number: number): boolean {
    const { faceOf } = this.#pass;
    return number < faceOf.length && faceOf.at(number) !== NONE;
  }

  #face(number: number): number {
    return number >= 0 && this.#isFace(number)
      ? this.#pass.faceOf.at(number)
      : this.#fail(`the front has no face ${number}`);
  }

  #node(number: number): number {
    const { nodeOf } = this.#pass;
    return number >= 0 && number < nodeOf.length
      ? nodeOf.at(number)
      : this.#fail(`there is no node ${number}`);
  }

  #element(number: number, isAlive: boolean): number {
    const { elementOf } = this.#pass;
    const element =
      number < elementOf.length ? elementOf.at(number) : this.#fail(`there is no element ${number}`);
    if (this.elements.isAlive(element) !== isAlive)
      this.#fail(`element ${number} has ${isAlive ? "already" : "not"} been removed`);
    return element;
  }

  #fail(message: string): never {
    return this.#cursor.fail(message, this.#eventOffset);
  }
}
