/**
 * All that a trace ever makes, in the order in which it is made, with the steps at which each thing is born and dies.
 * State k is the one after step k; a thing is part of it if `born <= k < died`. So no state needs a replay.
 */
import { GrowingArray } from "./growing-array.js";
import { NEVER } from "./layout.js";

/** Things of one kind, by index. */
export interface Lifetimes {
  /** State from which on the thing exists; ascending. */
  readonly born: Uint32Array;
  /** First state without the thing; NEVER if it stays to the end. */
  readonly died: Uint32Array;
  /** The things that do not stay to the end, in the order in which they die. */
  readonly ended: Uint32Array;
}

export interface TraceNodes extends Lifetimes {
  /** x y z per node. Those of the boundary come first and never die. */
  readonly positions: Float64Array;
  /** Layer per node: 0 on the boundary, growing inward. */
  readonly layers: Uint16Array;
}

export interface TraceFaces extends Lifetimes {
  /** Three nodes per face, counter-clockwise seen from its empty side. */
  readonly nodes: Uint32Array;
  /** Region on the empty side. */
  readonly regions: Uint32Array;
}

export interface TraceElements extends Lifetimes {
  /** Four nodes per element; the first three are counter-clockwise seen from the fourth. */
  readonly nodes: Uint32Array;
  readonly regions: Uint32Array;
}

class LifetimeColumns {
  readonly #born = new GrowingArray(Uint32Array);
  readonly #died = new GrowingArray(Uint32Array);
  readonly #ended = new GrowingArray(Uint32Array);

  get length(): number {
    return this.#born.length;
  }

  isAlive(index: number): boolean {
    return this.#died.at(index) === NEVER;
  }

  begin(step: number): number {
    this.#born.push(step);
    this.#died.push(NEVER);
    return this.#born.length - 1;
  }

  end(index: number, step: number): void {
    this.#died.set(index, step);
    this.#ended.push(index);
  }

  lifetimes(): Lifetimes {
    return { born: this.#born.copy(), died: this.#died.copy(), ended: this.#ended.copy() };
  }
}

export class NodeColumns extends LifetimeColumns {
  readonly #positions = new GrowingArray(Float64Array);
  readonly #layers = new GrowingArray(Uint16Array);

  add(position: readonly [number, number, number], layer: number, step: number): number {
    for (const coordinate of position) this.#positions.push(coordinate);
    this.#layers.push(Math.min(layer, 0xffff));
    return this.begin(step);
  }

  layer(index: number): number {
    return this.#layers.at(index);
  }

  taken(): TraceNodes {
    return { ...this.lifetimes(), positions: this.#positions.copy(), layers: this.#layers.copy() };
  }
}

/** Faces or elements. */
export class SimplexColumns extends LifetimeColumns {
  readonly #nodes = new GrowingArray(Uint32Array);
  readonly #regions = new GrowingArray(Uint32Array);

  constructor(readonly corners: 3 | 4) {
    super();
  }

  add(nodes: readonly number[], region: number, step: number): number {
    for (const node of nodes) this.#nodes.push(node);
    this.#regions.push(region);
    return this.begin(step);
  }

  node(index: number, corner: number): number {
    return this.#nodes.at(this.corners * index + corner);
  }

  region(index: number): number {
    return this.#regions.at(index);
  }

  taken(): Lifetimes & { readonly nodes: Uint32Array; readonly regions: Uint32Array } {
    return { ...this.lifetimes(), nodes: this.#nodes.copy(), regions: this.#regions.copy() };
  }
}

/** What each step is, and the candidates that it tried. */
export interface TraceSteps {
  /** Per step, from 1: offset of its event in the file. Entry 0 is unused. */
  readonly offsets: Uint32Array;
  /** Per step: entry of OUTCOMES. */
  readonly outcomes: Uint8Array;
  /** Per step: its base face; NONE for a step of recovery. */
  readonly bases: Uint32Array;
  /** Per state: number of faces, of elements and of nodes that were ever made until then, and faces of the front. */
  readonly facesMade: Uint32Array;
  readonly elementsMade: Uint32Array;
  readonly nodesMade: Uint32Array;
  readonly frontSizes: Uint32Array;
  /** Per step k: its candidates are those from `firstCandidates[k]` to `firstCandidates[k + 1]`. */
  readonly firstCandidates: Uint32Array;
  /** Per candidate: node, NONE if it is new and refused. */
  readonly candidateNodes: Uint32Array;
  /** Per candidate: face that it crosses or is too close to; else NONE. */
  readonly candidateCulprits: Uint32Array;
  /** Per candidate: index in REFUSALS, or ACCEPTED. */
  readonly candidateVerdicts: Uint8Array;
}

/** Entry of `candidateVerdicts` for the candidate that is accepted. */
export const ACCEPTED = 255;

export class StepColumns {
  readonly #offsets = new GrowingArray(Uint32Array);
  readonly #outcomes = new GrowingArray(Uint8Array);
  readonly #bases = new GrowingArray(Uint32Array);
  readonly #facesMade = new GrowingArray(Uint32Array);
  readonly #elementsMade = new GrowingArray(Uint32Array);
  readonly #nodesMade = new GrowingArray(Uint32Array);
  readonly #frontSizes = new GrowingArray(Uint32Array);
  readonly #firstCandidates = new GrowingArray(Uint32Array);
  readonly #candidateNodes = new GrowingArray(Uint32Array);
  readonly #candidateCulprits = new GrowingArray(Uint32Array);
  readonly #candidateVerdicts = new GrowingArray(Uint8Array);

  /** Number of steps begun; entry 0 of the columns is state 0. */
  get count(): number {
    return this.#offsets.length - 1;
  }

  begin(offset: number, base: number): void {
    this.#offsets.push(offset);
    this.#bases.push(base);
    this.#firstCandidates.push(this.#candidateNodes.length);
  }

  addCandidate(node: number, culprit: number, verdict: number): void {
    this.#candidateNodes.push(node);
    this.#candidateCulprits.push(culprit);
    this.#candidateVerdicts.push(verdict);
  }

  /** Ends the step that was begun last. */
  end(outcome: number, made: { faces: number; elements: number; nodes: number }, frontSize: number): void {
    this.#outcomes.push(outcome);
    this.#facesMade.push(made.faces);
    this.#elementsMade.push(made.elements);
    this.#nodesMade.push(made.nodes);
    this.#frontSizes.push(frontSize);
  }

  /** Adds to the last state the faces of a front that begins there. */
  addFirstFaces(facesMade: number, frontSize: number): void {
    const last = this.#facesMade.length - 1;
    this.#facesMade.set(last, facesMade);
    this.#frontSizes.set(last, frontSize);
  }

  taken(): TraceSteps {
    this.#firstCandidates.push(this.#candidateNodes.length);
    return {
      offsets: this.#offsets.copy(),
      outcomes: this.#outcomes.copy(),
      bases: this.#bases.copy(),
      facesMade: this.#facesMade.copy(),
      elementsMade: this.#elementsMade.copy(),
      nodesMade: this.#nodesMade.copy(),
      frontSizes: this.#frontSizes.copy(),
      firstCandidates: this.#firstCandidates.copy(),
      candidateNodes: this.#candidateNodes.copy(),
      candidateCulprits: this.#candidateCulprits.copy(),
      candidateVerdicts: this.#candidateVerdicts.copy(),
    };
  }
}
