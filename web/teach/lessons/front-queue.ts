/**
 * The queue of the front, a heap with the next base face on top (Löhner & Parikh 1988, second section 6, structure (1)), as
 * it goes through the steps of a trace. The engine's heap has four children per node and keys with more parts; here there
 * are two, and among faces of equal rank the one that the trace takes first comes first.
 */
import type { Trace } from "tetrafront/trace";
import { faceSize } from "../player/front-values";

/** What a face is ordered by: lower numbers first, from left to right. */
export interface QueueRank {
  /** Number of rule classes under which the face has failed. */
  readonly ruleClass: number;
  /** Bucket of the size, or the size itself in the order smallest first; 0 in orders that ignore the size. */
  readonly size: number;
  /** Sum of the layers of the nodes; 0 in other orders than the layered one. */
  readonly layers: number;
}

/** Buckets span a factor of 4, two octaves; one of them is centred on the typical size. */
const octavesPerBucket = 2;
const bucketOctaves = 127;

/** What the last step has done to the queue. */
export interface QueueWork {
  readonly taken: number;
  readonly joined: readonly number[];
  readonly left: number;
  /** Comparisons of two faces. */
  readonly comparisons: number;
}

/** Steps between two states that are kept, from which others are replayed. */
const keptEvery = 1024;

/** Faces or steps that are prepared between two looks at the clock. */
const workPerCheck = 256;

/** The heap after each step of a trace. */
export class FrontQueue {
  /** Faces in the order of the heap: the children of entry i are entries 2 i + 1 and 2 i + 2. */
  readonly faces: number[] = [];
  readonly #trace: Trace;
  /** Parts of the rank per face. */
  readonly #sizes: Float64Array;
  readonly #layers: Uint32Array;
  /** Faces and steps that are prepared. */
  #rankedFaces = 0;
  #readSteps = 0;
  /** Rule classes of the few faces that have failed. */
  #ruleClasses = new Map<number, number>();
  /** States that were kept, by their step divided by `keptEvery`. */
  readonly #kept = new Map<
    number,
    { readonly faces: readonly number[]; readonly ruleClasses: ReadonlyMap<number, number> }
  >();
  /** Steps that have each face as base, ascending. */
  readonly #baseSteps = new Map<number, number[]>();
  readonly #slots = new Map<number, number>();
  #step = -1;
  #comparisons = 0;
  #work: QueueWork | null = null;

  constructor(trace: Trace) {
    this.#trace = trace;
    this.#sizes = new Float64Array(trace.faces.born.length);
    this.#layers = new Uint32Array(trace.faces.born.length);
  }

  /** Ranks the next face, or notes the base of the next step; false when all are prepared. */
  #prepare(): boolean {
    const trace = this.#trace;
    const { order } = trace.header;
    const face = this.#rankedFaces;
    if (face < this.#sizes.length) {
      const size = Math.fround(faceSize(trace, face));
      const bucket = order === "layered" ? bucketOf(size, typicalSizeOf(trace, face)) : 0;
      this.#sizes[face] = order === "smallest-first" ? size : bucket;
      this.#layers[face] = order === "layered" ? layersOf(trace, face) : 0;
      this.#rankedFaces++;
      return true;
    }
    if (this.#readSteps === trace.stepCount) return false;
    const step = ++this.#readSteps;
    const base = trace.steps.bases[step] ?? this.#sizes.length;
    if (base >= this.#sizes.length) return true;
    const steps = this.#baseSteps.get(base);
    if (steps) steps.push(step);
    else this.#baseSteps.set(base, [step]);
    return true;
  }

  /** What the step shown has done; null in the first state, and in steps of recovery. */
  get work(): QueueWork | null {
    return this.#work;
  }

  /** Shows the queue after a step. O((steps between + faces) log faces), with at most `keptEvery` steps if it was there before. */
  show(step: number): void {
    this.showWithin(step, Infinity);
  }

  /** Works towards the queue after a step for about `milliseconds`; returns true once it is shown. */
  showWithin(step: number, milliseconds: number): boolean {
    const end = performance.now() + milliseconds;
    const isLate = (): boolean => performance.now() > end;
    for (let done = 1; this.#prepare(); done++) if (done % workPerCheck === 0 && isLate()) return false;
    // One step is replayed at least: a kept state does not know what its step has done.
    const kept = Math.max(0, Math.floor((step - 1) / keptEvery));
    if (step < this.#step || this.#step < 0 || (this.#kept.has(kept) && this.#step < kept * keptEvery))
      this.#restore(kept);
    while (this.#step < step) {
      this.#advance();
      if (isLate()) return this.#step === step;
    }
    return true;
  }

  /** What a face is ordered by at present. */
  rankOf(face: number): QueueRank {
    return {
      ruleClass: this.#ruleClasses.get(face) ?? 0,
      size: this.#sizes[face] ?? 0,
      layers: this.#layers[face] ?? 0,
    };
  }

  /** Goes to the last kept state of an index or before, or to the first state. */
  #restore(index: number): void {
    let at = index;
    while (at > 0 && !this.#kept.has(at)) at--;
    const kept = this.#kept.get(at);
    this.faces.length = 0;
    this.#slots.clear();
    this.#work = null;
    this.#step = at * keptEvery;
    if (kept) {
      kept.faces.forEach((face, slot) => this.#put(slot, face));
      this.#ruleClasses = new Map(kept.ruleClasses);
      return;
    }
    this.#ruleClasses.clear();
    for (let face = 0; face < (this.#trace.steps.facesMade[0] ?? 0); face++) this.#push(face);
  }

  #keep(): void {
    const index = this.#step / keptEvery;
    if (!Number.isInteger(index) || this.#kept.has(index)) return;
    this.#kept.set(index, { faces: [...this.faces], ruleClasses: new Map(this.#ruleClasses) });
  }

  #advance(): void {
    const step = ++this.#step;
    const { removedFaces, addedFaces } = this.#trace.changesAt(step);
    const { bases, outcomes, facesMade } = this.#trace.steps;
    const base = bases[step] ?? 0;
    const hasBase = base < this.#sizes.length;
    this.#comparisons = 0;
    if (hasBase) this.#remove(base);
    const left = removedFaces.filter((face) => face !== base);
    for (const face of left) this.#remove(face);
    const joined = Array.from(addedFaces);
    for (const face of joined) this.#push(face);
    // A postponed face comes again under another rule class, or is set aside.
    if (hasBase && outcomes[step] === 1) {
      const decoded = this.#trace.stepAt(step);
      const next = decoded?.kind === "advance" ? decoded.nextRuleClass : null;
      if (next !== null) {
        this.#ruleClasses.set(base, next);
        this.#push(base);
      }
    }
    this.#work = hasBase ? { taken: base, joined, left: left.length, comparisons: this.#comparisons } : null;
    // A front that begins after this step is not its work.
    const [from = 0, to = 0] = [facesMade[step - 1], facesMade[step]];
    for (let face = from + joined.length; face < to; face++) this.#push(face);
    this.#keep();
  }

  #isBefore(a: number, b: number): boolean {
    this.#comparisons++;
    const [ruleClass, others] = [this.#ruleClasses.get(a) ?? 0, this.#ruleClasses.get(b) ?? 0];
    if (ruleClass !== others) return ruleClass < others;
    for (const part of [this.#sizes, this.#layers]) {
      const difference = (part[a] ?? 0) - (part[b] ?? 0);
      if (difference !== 0) return difference < 0;
    }
    const [next, other] = [this.#nextStepOf(a), this.#nextStepOf(b)];
    return next === other ? a < b : next < other;
  }

  /** The next step of which a face is the base; Infinity if there is none. */
  #nextStepOf(face: number): number {
    return this.#baseSteps.get(face)?.find((step) => step > this.#step) ?? Infinity;
  }

  #push(face: number): void {
    this.faces.push(face);
    this.#rise(this.faces.length - 1, face);
  }

  #remove(face: number): void {
    const slot = this.#slots.get(face);
    if (slot === undefined) return;
    this.#slots.delete(face);
    const last = this.faces.pop();
    if (last === undefined || last === face) return;
    if (slot > 0 && this.#isBefore(last, this.faces[(slot - 1) >> 1] ?? 0)) this.#rise(slot, last);
    else this.#sink(slot, last);
  }

  #put(slot: number, face: number): void {
    this.faces[slot] = face;
    this.#slots.set(face, slot);
  }

  #rise(from: number, face: number): void {
    let slot = from;
    while (slot > 0) {
      const parent = (slot - 1) >> 1;
      const above = this.faces[parent] ?? 0;
      if (!this.#isBefore(face, above)) break;
      this.#put(slot, above);
      slot = parent;
    }
    this.#put(slot, face);
  }

  #sink(from: number, face: number): void {
    let slot = from;
    for (;;) {
      let child = 2 * slot + 1;
      if (child >= this.faces.length) break;
      if (child + 1 < this.faces.length && this.#isBefore(this.faces[child + 1] ?? 0, this.faces[child] ?? 0))
        child++;
      const below = this.faces[child] ?? 0;
      if (!this.#isBefore(below, face)) break;
      this.#put(slot, below);
      slot = child;
    }
    this.#put(slot, face);
  }
}

const typicalSizeOf = ({ fronts }: Trace, face: number): number =>
  fronts.findLast(({ firstFace }) => firstFace <= face)?.typicalSize ?? 1;

/** Returns the sum of the layers of a face's nodes. */
function layersOf({ faces, nodes }: Trace, face: number): number {
  let layers = 0;
  for (let corner = 0; corner < 3; corner++) layers += nodes.layers[faces.nodes[3 * face + corner] ?? 0] ?? 0;
  return layers;
}

/** Returns the bucket of a size, as the engine computes it: from the bits of a float, which grow about with its logarithm. */
function bucketOf(size: number, typicalSize: number): number {
  const ratio = Math.fround(size / typicalSize);
  const octave = Math.floor(Math.log2(ratio));
  const exact = ratio >= 2 ** (octave + 1) ? octave + 1 : ratio < 2 ** octave ? octave - 1 : octave;
  return Math.max(0, Math.floor((exact + bucketOctaves) / octavesPerBucket));
}
