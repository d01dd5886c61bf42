/** The optimization at the end of a trace, sweep by sweep. */
import { GrowingArray } from "./growing-array.js";
import { NONE } from "./layout.js";
import { readSweepGeometry, type SweepEvents, type SweepMeasures, type TracedSweep } from "./sweep-events.js";
import { TraceCursor } from "./trace-cursor.js";

/** The mesh after a sweep. */
export interface SweptMesh {
  /** x y z per node, those included that no element uses any more. Positions are rounded to about five digits of each move. */
  readonly points: Float64Array;
  /** Four nodes per tetrahedron. */
  readonly tetrahedra: Uint32Array;
  /** Region per tetrahedron. */
  readonly regions: Uint32Array;
  /** 1 for each tetrahedron that the sweep has made or replaced, or one of whose nodes it has moved. */
  readonly isChanged: Uint8Array;
}

/** The sweeps of the optimizer after the front, as recorded. */
export class TracedOptimization {
  readonly #bytes: Uint8Array;
  readonly #offsets: readonly number[];
  readonly #boundary: Float64Array;
  #state: SweepState;

  constructor(bytes: Uint8Array, { before, sweeps, result, offsets }: SweepEvents, boundary: Float64Array) {
    this.#bytes = bytes;
    this.#offsets = offsets;
    this.#boundary = boundary;
    this.#state = new SweepState(boundary);
    this.before = before;
    this.sweeps = sweeps;
    this.result = result;
  }

  /** The mesh of the front, before the first sweep. */
  readonly before: SweepMeasures;
  /** The sweeps, in their order. */
  readonly sweeps: readonly TracedSweep[];
  /** Number of the sweep whose mesh is the result, from 1: the last one, unless an earlier mesh was better; 0 for that before. */
  readonly result: number;

  /** Whether `meshAfter` returns meshes: true for up to 100 000 elements. */
  get hasMeshes(): boolean {
    return this.#offsets.length > 0;
  }

  /**
   * Returns the mesh after sweep `sweep`, from 1; that before the first one for 0; undefined for other numbers, and of meshes
   * that are too large to be recorded. The next sweep is found in O(elements), earlier ones from the first.
   */
  meshAfter(sweep: number): SweptMesh | undefined {
    if (!Number.isInteger(sweep) || sweep < 0 || sweep >= this.#offsets.length) return undefined;
    if (this.#state.sweep >= sweep) this.#state = new SweepState(this.#boundary);
    while (this.#state.sweep < sweep) {
      const offset = this.#offsets[this.#state.sweep + 1] ?? 0;
      this.#state.apply(new TraceCursor(this.#bytes, offset));
    }
    return this.#state.mesh();
  }
}

/** A mesh that the sweeps are applied to, with the numbers of the optimizer. */
class SweepState {
  /** Number of the last sweep; -1 before the first mesh. */
  sweep = -1;
  readonly #positions = new GrowingArray(Float64Array);
  /** Per slot, four nodes and the region; the first node of an empty slot is NONE. */
  readonly #slots = new GrowingArray(Uint32Array);
  #movedNodes: ReadonlySet<number> = new Set();
  #changed: ReadonlySet<number> = new Set();

  constructor(boundary: Float64Array) {
    for (const coordinate of boundary) this.#positions.push(coordinate);
  }

  apply(cursor: TraceCursor): void {
    const geometry = readSweepGeometry(cursor, this.sweep >= 0);
    this.sweep++;
    geometry.movedNodes.forEach((node, i) => {
      for (let axis = 0; axis < 3; axis++) {
        const at = 3 * node + axis;
        this.#positions.set(at, this.#positions.at(at) + (geometry.moves[3 * i + axis] ?? 0));
      }
    });
    for (const coordinate of geometry.newNodes) this.#positions.push(coordinate);
    for (const slot of geometry.removedElements) this.#slots.set(5 * slot, NONE);
    const slots = 5 * ((geometry.elements.at(-1) ?? -1) + 1);
    if (slots > this.#slots.length) this.#slots.resize(slots, NONE);
    geometry.elements.forEach((slot, i) => {
      for (let k = 0; k < 5; k++) this.#slots.set(5 * slot + k, geometry.corners[5 * i + k] ?? 0);
    });
    this.#movedNodes = new Set(geometry.movedNodes);
    this.#changed = this.sweep === 0 ? new Set() : new Set(geometry.elements);
  }

  mesh(): SweptMesh {
    const slots = this.#slots.copy();
    const count = slots.length / 5;
    const tetrahedra = new Uint32Array(4 * count);
    const regions = new Uint32Array(count);
    const isChanged = new Uint8Array(count);
    let live = 0;
    for (let slot = 0; slot < count; slot++) {
      if (slots[5 * slot] === NONE) continue;
      const nodes = slots.subarray(5 * slot, 5 * slot + 4);
      tetrahedra.set(nodes, 4 * live);
      regions[live] = slots[5 * slot + 4] ?? 0;
      const isMoved = nodes.some((node) => this.#movedNodes.has(node));
      isChanged[live++] = isMoved || this.#changed.has(slot) ? 1 : 0;
    }
    return {
      points: this.#positions.copy(),
      tetrahedra: tetrahedra.slice(0, 4 * live),
      regions: regions.slice(0, live),
      isChanged: isChanged.slice(0, live),
    };
  }
}
