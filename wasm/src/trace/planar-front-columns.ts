/** The 2-D front of a patch while its events are read. */
import { GrowingArray } from "./growing-array.js";
import { NEVER, NONE, type PlanarEnd } from "./layout.js";
import type { PatchEvent } from "./surface-events.js";
import type { ImprovedPatch, PlanarFront } from "./surface-steps.js";
import { Fingerprint } from "./fingerprint.js";

export class PlanarFrontColumns {
  readonly patch: number;
  readonly #event: PatchEvent;
  readonly #firstStep: number;
  readonly #plane = new GrowingArray(Float64Array);
  readonly #positions = new GrowingArray(Float64Array);
  readonly #nodesBorn = new GrowingArray(Uint32Array);
  readonly #edges = new GrowingArray(Uint32Array);
  readonly #edgesBorn = new GrowingArray(Uint32Array);
  readonly #edgesDied = new GrowingArray(Uint32Array);
  readonly #triangles = new GrowingArray(Uint32Array);
  readonly #trianglesBorn = new GrowingArray(Uint32Array);
  /** Per number of the engine: the edge that has it at present, or NONE. */
  readonly #edgeOf = new GrowingArray(Uint32Array);
  /** Number of edges of the front at present. */
  size = 0;
  /** Numbers of the base edge before. */
  lastBase = 0;
  lastSizeClass = 0;
  #improved: ImprovedPatch | null = null;
  end: PlanarEnd = "covered";

  /** `positions`: x y z per node of the boundary. */
  constructor(event: PatchEvent, step: number, positions: Float64Array) {
    this.patch = event.patch;
    this.#event = event;
    this.#firstStep = step;
    for (let node = 0; node < event.surfaceNodes.length; node++) {
      const [x = 0, y = 0] = event.plane.subarray(2 * node, 2 * node + 2);
      this.addNode([x, y], [...positions.subarray(3 * node, 3 * node + 3)], step);
    }
  }

  get boundaryNodes(): number {
    return this.#event.surfaceNodes.length;
  }

  get nodeCount(): number {
    return this.#nodesBorn.length;
  }

  get edgeCount(): number {
    return this.#edgesBorn.length;
  }

  get triangleCount(): number {
    return this.#trianglesBorn.length;
  }

  /** Index of the present edge with a number of the engine; undefined if the front has none. */
  edgeOf(number: number): number | undefined {
    const edge = number >= 0 && number < this.#edgeOf.length ? this.#edgeOf.at(number) : NONE;
    return edge === NONE ? undefined : edge;
  }

  ends(edge: number): readonly [number, number] {
    return [this.#edges.at(2 * edge), this.#edges.at(2 * edge + 1)];
  }

  plane(node: number): readonly [number, number] {
    return [this.#plane.at(2 * node), this.#plane.at(2 * node + 1)];
  }

  position(node: number): readonly [number, number, number] {
    return [this.#positions.at(3 * node), this.#positions.at(3 * node + 1), this.#positions.at(3 * node + 2)];
  }

  addNode(plane: readonly [number, number], position: readonly number[], step: number): number {
    for (const coordinate of plane) this.#plane.push(coordinate);
    for (const coordinate of position) this.#positions.push(coordinate);
    this.#nodesBorn.push(step);
    return this.nodeCount - 1;
  }

  addEdge(number: number, from: number, to: number, step: number): void {
    if (number >= this.#edgeOf.length) this.#edgeOf.resize(number + 1, NONE);
    this.#edgeOf.set(number, this.edgeCount);
    this.#edges.push(from);
    this.#edges.push(to);
    this.#edgesBorn.push(step);
    this.#edgesDied.push(NEVER);
    ++this.size;
  }

  removeEdge(number: number, step: number): void {
    const edge = this.edgeOf(number);
    if (edge === undefined) return;
    this.#edgesDied.set(edge, step);
    this.#edgeOf.set(number, NONE);
    --this.size;
  }

  addTriangle(nodes: readonly [number, number, number], step: number): void {
    for (const node of nodes) this.#triangles.push(node);
    this.#trianglesBorn.push(step);
  }

  /** Hash of the triangles: 16 hexadecimal digits. */
  hash(): string {
    const fingerprint = new Fingerprint();
    fingerprint.addIntegers(this.#triangles.copy());
    return fingerprint.text();
  }

  improve(interior: Float64Array, triangles: Uint32Array): void {
    const boundary = this.#plane.copy().subarray(0, 2 * this.boundaryNodes);
    const plane = new Float64Array(boundary.length + interior.length);
    plane.set(boundary);
    plane.set(interior, boundary.length);
    this.#improved = { plane, triangles };
  }

  taken(lastStep: number): PlanarFront {
    const { patch, isCurved, isRepeated, surfaceNodes, carriers, seam } = this.#event;
    return {
      patch,
      isCurved,
      isRepeated,
      firstStep: this.#firstStep,
      lastStep,
      boundaryNodes: this.boundaryNodes,
      seamNodes: seam.length / 3,
      plane: this.#plane.copy(),
      positions: this.#positions.copy(),
      surfaceNodes,
      carriers,
      edges: this.#edges.copy(),
      edgesBorn: this.#edgesBorn.copy(),
      edgesDied: this.#edgesDied.copy(),
      triangles: this.#triangles.copy(),
      trianglesBorn: this.#trianglesBorn.copy(),
      nodesBorn: this.#nodesBorn.copy(),
      end: this.end,
      improved: this.#improved,
    };
  }
}
