/** The nodes of a file that lie on edges of second-order elements. The mesh is read by the corners of its elements. */
import { plural } from "../base/plural.js";
import type { Mesh, NodeData } from "../mesh/mesh.js";
import { Column } from "./column.js";
import { edgesOf } from "./second-order.js";

/** Distance of a node from the middle of its edge / length of the edge, above which the edge counts as curved. */
const CURVED = 1e-6;

export class SecondOrderNodes {
  readonly #middles = new Column(Uint32Array);
  #elements = 0;
  #curved = 0;

  /** `nodes`: those of a triangle (6) or tetrahedron (10). `points`: x y z of every node. */
  add(nodes: readonly number[], points: Column<Float64Array>): void {
    const edges = edgesOf(nodes.length);
    const corners = nodes.length - edges.length / 2;
    const at = (node: number | undefined, axis: number) => points.at(3 * (node ?? 0) + axis);
    let isCurved = false;
    for (let e = 0; 2 * e < edges.length; e++) {
      const [a, b, middle = 0] = [nodes[edges[2 * e] ?? 0], nodes[edges[2 * e + 1] ?? 0], nodes[corners + e]];
      let [off, length] = [0, 0];
      for (let axis = 0; axis < 3; axis++) {
        const [x, y, z] = [at(a, axis), at(b, axis), at(middle, axis)];
        off += (z - 0.5 * x - 0.5 * y) ** 2;
        length += (y - x) ** 2;
      }
      isCurved ||= off > CURVED * CURVED * length;
      this.#middles.push(middle);
    }
    this.#elements++;
    if (isCurved) this.#curved++;
  }

  /** Returns the mesh without these nodes, except those that are corners of other elements, and with a note. O(n). */
  leftOutOf(mesh: Mesh): Mesh {
    if (this.#elements === 0) return mesh;
    const { points, triangles, tetrahedra, nodeData } = mesh;
    const isLeftOut = new Uint8Array(points.length / 3);
    for (const node of this.#middles.taken()) isLeftOut[node] = 1;
    for (const node of triangles) isLeftOut[node] = 0;
    for (const node of tetrahedra) isLeftOut[node] = 0;
    const indexOf = new Uint32Array(isLeftOut.length);
    let count = 0;
    isLeftOut.forEach((left, node) => (indexOf[node] = left === 0 ? count++ : 0));
    const kept = (values: Float64Array, width: number) => {
      const rows = new Float64Array(width * count);
      isLeftOut.forEach((left, node) => {
        if (left === 0)
          rows.set(values.subarray(width * node, width * (node + 1)), width * (indexOf[node] ?? 0));
      });
      return rows;
    };
    const data = [...nodeData].map(([name, { components, values }]): [string, NodeData] => [
      name,
      { components, values: kept(values, components) },
    ]);
    return {
      ...mesh,
      points: kept(points, 3),
      triangles: triangles.map((node) => indexOf[node] ?? 0),
      tetrahedra: tetrahedra.map((node) => indexOf[node] ?? 0),
      nodeData: new Map(data),
      notes: [...(mesh.notes ?? []), this.#note()],
    };
  }

  #note(): string {
    const read = `${plural(this.#elements, "second-order element")} read by the corners, as linear elements`;
    return this.#curved === 0
      ? read
      : `${read}; ${this.#curved} of them had curved edges, which are straight now`;
  }
}
