import type { SolvedMesh, Vector } from "./problem";

/** A linear element: its volume, and the gradients of its four shape functions. */
export interface LinearElement {
  readonly nodes: Uint32Array;
  readonly volume: number;
  /** x y z of the gradient per corner. */
  readonly gradients: Float64Array;
}

/** Calls back for every element of a mesh that has a volume, in order. The arrays hold only until the next call. */
export function forEachElement(
  { points, tetrahedra }: Pick<SolvedMesh, "points" | "tetrahedra">,
  visit: (element: LinearElement) => void,
): void {
  const gradients = new Float64Array(12);
  for (let first = 0; first < tetrahedra.length; first += 4) {
    const nodes = tetrahedra.subarray(first, first + 4);
    const volume = writeGradients(points, nodes, gradients);
    if (volume > 0) visit({ nodes, volume, gradients });
  }
}

/**
 * Writes the gradients and returns the volume. The gradient of corner b is (c−a)×(d−a) / 6V, in turn for c and d; all four
 * sum to zero.
 */
function writeGradients(points: Float64Array, nodes: Uint32Array, gradients: Float64Array): number {
  const [ax, ay, az] = positionOf(points, nodes[0] ?? 0);
  const [bx, by, bz] = edgeTo(points, nodes[1] ?? 0, ax, ay, az);
  const [cx, cy, cz] = edgeTo(points, nodes[2] ?? 0, ax, ay, az);
  const [dx, dy, dz] = edgeTo(points, nodes[3] ?? 0, ax, ay, az);
  const [gx, gy, gz] = [cy * dz - cz * dy, cz * dx - cx * dz, cx * dy - cy * dx];
  gradients.set([gx, gy, gz], 3);
  gradients[6] = dy * bz - dz * by;
  gradients[7] = dz * bx - dx * bz;
  gradients[8] = dx * by - dy * bx;
  gradients[9] = by * cz - bz * cy;
  gradients[10] = bz * cx - bx * cz;
  gradients[11] = bx * cy - by * cx;
  const sixVolumes = bx * gx + by * gy + bz * gz;
  for (let k = 3; k < 12; ++k) gradients[k] = (gradients[k] ?? 0) / sixVolumes;
  for (let k = 0; k < 3; ++k)
    gradients[k] = -(gradients[3 + k] ?? 0) - (gradients[6 + k] ?? 0) - (gradients[9 + k] ?? 0);
  return sixVolumes / 6;
}

function positionOf(points: Float64Array, node: number): Vector {
  return [points[3 * node] ?? 0, points[3 * node + 1] ?? 0, points[3 * node + 2] ?? 0];
}

function edgeTo(points: Float64Array, node: number, x: number, y: number, z: number): Vector {
  const [px, py, pz] = positionOf(points, node);
  return [px - x, py - y, pz - z];
}

/** Calls back for every triangle whose patch has a condition, in order, with the area of the triangle and the index of its patch. */
export function forEachTriangle<Condition>(
  { points, triangles, trianglePatch }: SolvedMesh,
  conditions: ReadonlyMap<number, Condition>,
  visit: (nodes: Uint32Array, condition: Condition, area: number, patch: number) => void,
): void {
  for (let t = 0; 3 * t < triangles.length; ++t) {
    const patch = trianglePatch[t] ?? 0;
    const condition = conditions.get(patch);
    if (condition === undefined) continue;
    const nodes = triangles.subarray(3 * t, 3 * t + 3);
    visit(nodes, condition, areaOf(points, nodes), patch);
  }
}

function areaOf(points: Float64Array, nodes: Uint32Array): number {
  const [x, y, z] = positionOf(points, nodes[0] ?? 0);
  const [ax, ay, az] = edgeTo(points, nodes[1] ?? 0, x, y, z);
  const [bx, by, bz] = edgeTo(points, nodes[2] ?? 0, x, y, z);
  return Math.hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx) / 2;
}

/**
 * Returns values at the nodes from a constant value per element: the mean of the elements around a node, weighted by their
 * volumes.
 */
export function averagedAtNodes(
  mesh: SolvedMesh,
  components: number,
  valueOf: (element: LinearElement, out: Float64Array) => void,
): Float64Array<ArrayBuffer> {
  const nodeCount = mesh.points.length / 3;
  const values = new Float64Array(components * nodeCount);
  const volumes = new Float64Array(nodeCount);
  const out = new Float64Array(components);
  forEachElement(mesh, (element) => {
    valueOf(element, out);
    for (const node of element.nodes) {
      volumes[node] = (volumes[node] ?? 0) + element.volume;
      for (let k = 0; k < components; ++k) {
        const at = components * node + k;
        values[at] = (values[at] ?? 0) + element.volume * (out[k] ?? 0);
      }
    }
  });
  for (let i = 0; i < values.length; ++i) {
    const volume = volumes[Math.floor(i / components)] ?? 0;
    if (volume > 0) values[i] = (values[i] ?? 0) / volume;
  }
  return values;
}
