/**
 * Second-order elements: every edge gets a node at its middle, which all elements at the edge share, or where the mesh has one. The
 * nodes of an element are its corners, then the middles of the edges 01 12 20 of a triangle, and 01 12 20 03 13 23 of a
 * tetrahedron, as in VTK, Abaqus and Nastran.
 */
import { type Steps, stepwise } from "../base/steps.js";
import type { CurvedEdges, Mesh, NodeData } from "../mesh/mesh.js";

/** Nodes at the middles of the edges: three per triangle, six per tetrahedron. */
export interface MidNodes {
  readonly triangles: Uint32Array;
  readonly tetrahedra: Uint32Array;
}

/** Mesh that a writer gets; with middle nodes if it writes second-order elements. */
export type WrittenMesh = Mesh & { readonly midNodes?: MidNodes | undefined };

const TRIANGLE_EDGES = [0, 1, 1, 2, 2, 0] as const;
const TETRAHEDRON_EDGES = [...TRIANGLE_EDGES, 0, 3, 1, 3, 2, 3] as const;

/** Returns the corners at the ends of each edge of an element with 6 or 10 nodes, in the order of its middle nodes. */
export function edgesOf(nodes: number): readonly number[] {
  return nodes === 10 ? TETRAHEDRON_EDGES : TRIANGLE_EDGES;
}

/**
 * Returns the mesh with the middle nodes after its own: those of `curvedEdges` where these are, all others halfway. The values at them are
 * the means of the ends of each edge. O(n).
 */
export function* withMidNodes(mesh: Mesh): Steps<Mesh & { readonly midNodes: MidNodes }> {
  const count = mesh.points.length / 3;
  const edges = new EdgeNodes(count);
  const [triangles, tetrahedra] = [
    new Uint32Array(mesh.triangles.length),
    new Uint32Array(1.5 * mesh.tetrahedra.length),
  ];
  const fill = (mids: Uint32Array, nodes: Uint32Array, corners: number, ends: readonly number[]) => {
    const perElement = ends.length / 2;
    return stepwise(nodes.length / corners, (element) => {
      for (let e = 0; e < perElement; e++) {
        const a = nodes[corners * element + (ends[2 * e] ?? 0)] ?? 0;
        const b = nodes[corners * element + (ends[2 * e + 1] ?? 0)] ?? 0;
        mids[perElement * element + e] = edges.middleOf(a, b);
      }
    });
  };
  yield* fill(tetrahedra, mesh.tetrahedra, 4, TETRAHEDRON_EDGES);
  yield* fill(triangles, mesh.triangles, 3, TRIANGLE_EDGES);
  const nodeData = new Map<string, NodeData>();
  for (const [name, { components, values }] of mesh.nodeData) {
    nodeData.set(name, { components, values: yield* edges.withMeans(values, components) });
  }
  const points = yield* edges.withMeans(mesh.points, 3);
  const { edges: curved, middles } = mesh.curvedEdges ?? NO_EDGES;
  yield* stepwise(curved.length / 2, (edge) => {
    const node = edges.knownMiddleOf(curved[2 * edge] ?? 0, curved[2 * edge + 1] ?? 0);
    if (node !== undefined) points.set(middles.subarray(3 * edge, 3 * edge + 3), 3 * node);
  });
  return { ...mesh, points, nodeData, midNodes: { triangles, tetrahedra } };
}

const NO_EDGES: CurvedEdges = { edges: new Uint32Array(), middles: new Float64Array() };

/** Numbers the edges: a hash table with the ends of each edge. */
class EdgeNodes {
  readonly #first: number;
  #ends = new Uint32Array(1 << 12);
  #size = 0;
  /** Number of the edge plus 1; 0 for an empty slot. The length is a power of two. */
  #slots = new Uint32Array(1 << 12);

  /** `first`: node of the first edge. */
  constructor(first: number) {
    this.#first = first;
  }

  middleOf(a: number, b: number): number {
    const [low, high] = a < b ? [a, b] : [b, a];
    const known = this.#slots[this.#slotOf(low, high)] ?? 0;
    if (known > 0) return this.#first + known - 1;
    if (2 * this.#size === this.#ends.length) this.#grow();
    const slot = this.#slotOf(low, high);
    this.#ends[2 * this.#size] = low;
    this.#ends[2 * this.#size + 1] = high;
    this.#slots[slot] = ++this.#size;
    return this.#first + this.#size - 1;
  }

  /** Returns the node of an edge; undefined if the edge has none. */
  knownMiddleOf(a: number, b: number): number | undefined {
    const known = this.#slots[this.#slotOf(Math.min(a, b), Math.max(a, b))] ?? 0;
    return known > 0 ? this.#first + known - 1 : undefined;
  }

  /** Returns the values of the nodes, then the mean values of the ends of each edge. */
  *withMeans(values: Float64Array, components: number): Steps<Float64Array> {
    const all = new Float64Array(values.length + components * this.#size);
    all.set(values);
    yield* stepwise(this.#size, (edge) => {
      const [a = 0, b = 0] = [this.#ends[2 * edge], this.#ends[2 * edge + 1]];
      for (let i = 0; i < components; i++) {
        const [x = 0, y = 0] = [values[components * a + i], values[components * b + i]];
        all[values.length + components * edge + i] = 0.5 * x + 0.5 * y;
      }
    });
    return all;
  }

  #slotOf(low: number, high: number): number {
    const mask = this.#slots.length - 1;
    let slot = (Math.imul(low, 0x9e3779b1) ^ Math.imul(high, 0x85ebca6b)) >>> 0;
    slot = (slot ^ (slot >>> 15)) & mask;
    for (;;) {
      const edge = (this.#slots[slot] ?? 0) - 1;
      if (edge < 0 || (this.#ends[2 * edge] === low && this.#ends[2 * edge + 1] === high)) return slot;
      slot = (slot + 1) & mask;
    }
  }

  /** Doubles the table, which is at most half full. */
  #grow(): void {
    const ends = new Uint32Array(2 * this.#ends.length);
    ends.set(this.#ends);
    this.#ends = ends;
    this.#slots = new Uint32Array(2 * this.#slots.length);
    for (let edge = 0; edge < this.#size; edge++) {
      this.#slots[this.#slotOf(ends[2 * edge] ?? 0, ends[2 * edge + 1] ?? 0)] = edge + 1;
    }
  }
}
