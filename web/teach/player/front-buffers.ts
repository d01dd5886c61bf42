import type { Trace } from "tetrafront/trace";
import type { Position } from "../../document/position";

const noSlot = -1;
/** Corners of a triangle. */
const corners = 3;
const none: readonly number[] = [];
/** Beyond this many steps it is faster to write all faces than to replay the steps. */
const maxReplayed = 1000;

/**
 * The front's triangles in arrays for the graphics card, written in place: a face that leaves the front frees its slot for
 * the next one that joins. Moving by one step writes a few faces; moving anywhere writes the front.
 */
export class FrontBuffers {
  /** x y z per corner, relative to the origin; all 0 in a free slot. */
  readonly positions: Float32Array<ArrayBuffer>;
  /** Value per corner, which the colour shows. */
  readonly values: Float32Array<ArrayBuffer>;
  readonly #trace: Trace;
  /** Slot of each face that was ever made; noSlot if it is not part of the front. */
  readonly #slotOf: Int32Array;
  readonly #free: number[] = [];
  #origin: Position = [0, 0, 0];
  #valueOf: (face: number) => number = () => 0;
  #slots = 0;
  #step = -1;
  /** Faces of the state that are left out. */
  #leftOut: readonly number[] = none;
  /** Slots written since the last call of `written`. */
  #written: [first: number, last: number] | null = null;

  constructor(trace: Trace) {
    this.#trace = trace;
    const capacity = trace.steps.frontSizes.reduce((most, size) => Math.max(most, size), 0);
    this.#slotOf = new Int32Array(trace.faces.born.length).fill(noSlot);
    this.positions = new Float32Array(9 * capacity);
    this.values = new Float32Array(corners * capacity);
  }

  /** Number of slots in use or freed: the corners to draw are three times as many. */
  get slotCount(): number {
    return this.#slots;
  }

  /** Sets where positions are relative to, and what the colours show; the next `show` writes all faces. */
  reset(origin: Position, valueOf: (face: number) => number): void {
    this.#origin = origin;
    this.#valueOf = valueOf;
    this.#step = -1;
  }

  /** Shows the state after a step, without some of its faces. */
  show(step: number, leftOut = none): void {
    if (step === this.#step && leftOut === this.#leftOut) return;
    const before = this.#leftOut;
    this.#leftOut = leftOut;
    this.#move(step, before);
    leftOut.forEach(this.#remove);
  }

  /** Moves to a state. `leftOut`: the faces of the present one that are not drawn. */
  #move(step: number, leftOut: readonly number[]): void {
    const from = this.#step;
    this.#step = step;
    if (from < 0 || Math.abs(step - from) > maxReplayed) return this.#writeAll(step);
    leftOut.forEach(this.#add);
    // Faces leave before others join, because there are only as many slots as the largest front has faces.
    for (let i = from + 1; i <= step; i++) {
      this.#trace.changesAt(i).removedFaces.forEach(this.#remove);
      this.#madeIn(i).forEach(this.#add);
    }
    for (let i = from; i > step; i--) {
      this.#madeIn(i).forEach(this.#remove);
      this.#trace.changesAt(i).removedFaces.forEach(this.#add);
    }
  }

  /** Returns the slots written since the last call; null if there are none. */
  written(): readonly [first: number, last: number] | null {
    const written = this.#written;
    this.#written = null;
    return written;
  }

  #writeAll(step: number): void {
    this.#slotOf.fill(noSlot);
    this.#free.length = 0;
    const before = this.#slots;
    this.#slots = 0;
    for (const face of this.#trace.frontAt(step)) this.#add(face);
    this.positions.fill(0, 9 * this.#slots, 9 * before);
    this.#note(0, Math.max(before, this.#slots) - 1);
  }

  /** Returns the faces that join in a step; those of a front that begins after it too. */
  #madeIn(step: number): number[] {
    const { facesMade } = this.#trace.steps;
    const first = facesMade[step - 1] ?? 0;
    return Array.from({ length: (facesMade[step] ?? 0) - first }, (_, i) => first + i);
  }

  readonly #remove = (face: number): void => {
    const slot = this.#slotOf[face] ?? noSlot;
    if (slot === noSlot) return;
    this.#slotOf[face] = noSlot;
    this.#free.push(slot);
    this.positions.fill(0, 9 * slot, 9 * slot + 9);
    this.#note(slot, slot);
  };

  readonly #add = (face: number): void => {
    const slot = this.#free.pop() ?? this.#slots++;
    this.#slotOf[face] = slot;
    const { faces, nodes } = this.#trace;
    const value = this.#valueOf(face);
    for (let corner = 0; corner < corners; corner++) {
      this.values[corners * slot + corner] = value;
      const node = faces.nodes[corners * face + corner] ?? 0;
      for (let axis = 0; axis < 3; axis++)
        this.positions[9 * slot + 3 * corner + axis] =
          (nodes.positions[3 * node + axis] ?? 0) - (this.#origin[axis] ?? 0);
    }
    this.#note(slot, slot);
  };

  #note(first: number, last: number): void {
    if (!this.#written) this.#written = [first, last];
    this.#written[0] = Math.min(this.#written[0], first);
    this.#written[1] = Math.max(this.#written[1], last);
  }
}
