/** The optimization at the end of a trace, sweep by sweep. */
import { GrowingArray } from "./growing-array.js";
import { NONE } from "./layout.js";
import { type OptimizationSummary, readSweepGeometry, type SweepEvents } from "./sweep-events.js";
import { TraceCursor } from "./trace-cursor.js";

/** The mesh after a sweep. */
export interface SweptMesh {
  /** x y z per node, those included that no element uses any more. Positions are rounded to about five digits of each move. */
  readonly points: Float64Array;
  /** Four nodes per tetrahedron. */
  readonly tetrahedra: Uint32Array;
  /** Region per tetrahedron. */
  readonly tetrahedronRegion: Uint32Array;
}

/** The sweeps of the optimizer after the front, as recorded. */
export class TracedOptimization {
  readonly #bytes: Uint8Array;
  readonly #offsets: readonly number[];
  readonly #changed: readonly number[];
  readonly #boundary: Float64Array;
  #state: SweepState;

  /** Angles, counts and changes of all sweeps. */
  readonly summary: OptimizationSummary;

  constructor(bytes: Uint8Array, { summary, offsets, changed }: SweepEvents, boundary: Float64Array) {
    this.#bytes = bytes;
    this.summary = summary;
    this.#offsets = offsets;
    this.#changed = changed;
    this.#boundary = boundary;
    this.#state = new SweepState(boundary);
  }

  /** Whether `meshAfter` returns meshes: true for up to 100 000 elements. */
  get hasMeshes(): boolean {
    return this.#offsets.length > 0;
  }

  /**
   * Returns the mesh after sweep `sweep`, from 1; that before the first one for 0; undefined for other numbers, and of meshes
   * that are too large to be recorded. The next sweep is found in O(elements), others from the first.
   */
  meshAfter(sweep: number): SweptMesh | undefined {
    if (!Number.isInteger(sweep) || sweep < 0 || sweep >= this.#offsets.length) return undefined;
    const path: number[] = [];
    for (let at = sweep; at >= 0 && at !== this.#state.sweep; at = this.#changed[at - 1] ?? -1)
      path.unshift(at);
    if (path[0] === 0) this.#state = new SweepState(this.#boundary);
    for (const next of path) this.#state.apply(new TraceCursor(this.#bytes, this.#offsets[next] ?? 0), next);
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

  constructor(boundary: Float64Array) {
    for (const coordinate of boundary) this.#positions.push(coordinate);
  }

  apply(cursor: TraceCursor, sweep: number): void {
    const geometry = readSweepGeometry(cursor, this.sweep >= 0);
    this.sweep = sweep;
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
  }

  mesh(): SweptMesh {
    const tetrahedra: number[] = [];
    const regions: number[] = [];
    for (let at = 0; at < this.#slots.length; at += 5) {
      if (this.#slots.at(at) === NONE) continue;
      for (let k = 0; k < 4; k++) tetrahedra.push(this.#slots.at(at + k));
      regions.push(this.#slots.at(at + 4));
    }
    return {
      points: this.#positions.copy(),
      tetrahedra: Uint32Array.from(tetrahedra),
      tetrahedronRegion: Uint32Array.from(regions),
    };
  }
}
