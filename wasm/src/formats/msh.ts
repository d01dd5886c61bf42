/**
 * Writes Gmsh MSH 4.1, binary: coordinates survive a round trip bit for bit. There is one surface entity and
 * physical group per patch, with its triangles, and one volume entity and physical group per region, with its
 * tetrahedra. The groups carry the user's names, for boundary conditions.
 */
import { inPieces, type Steps, stepwise } from "../base/steps.js";
import type { NodeData } from "../mesh/mesh.js";
import { IS_LITTLE_ENDIAN, type Part, widened } from "./bytes.js";
import { cellDataOf, cellsByGroup } from "./element-data.js";
import type { Note } from "./file-format.js";
import { type ElementKind, type Group, type Naming, patchGroups, regionGroups } from "./groups.js";
import type { WrittenMesh } from "./second-order.js";

/** Gmsh rejects files with longer names, in bytes. */
export const GMSH_NAMING: Naming = { maxBytes: 127 };

/** Returns the bytes of an MSH file. */
export function* writeMsh(mesh: WrittenMesh, note: Note): Generator<Part, void> {
  const { points } = mesh;
  const { groups, head } = yield* mshHead(mesh, note);
  yield [
    ...head,
    nodeTags(points.length / 3, groups),
    points,
    "\n$EndNodes\n$Elements\n",
    elements(groups),
    "\n$EndElements\n",
    dataSections(mesh),
  ];
}

/** Returns the groups of a mesh, and the begin of its file, up to the nodes. */
export function* mshHead(
  mesh: WrittenMesh,
  note: Note,
): Steps<{ readonly groups: readonly Group[]; readonly head: Part[] }> {
  const patches = yield* patchGroups(mesh, { ...GMSH_NAMING, note });
  const regions = yield* regionGroups(mesh, { ...GMSH_NAMING, note });
  const groups = [...patches, ...regions];
  const head = [
    // 1: binary; 8: bytes of a size_t. The number 1 that follows shows the byte order.
    "$MeshFormat\n4.1 1 8\n",
    Int32Array.of(1),
    "\n$EndMeshFormat\n",
    physicalNames(groups),
    "$Entities\n",
    entities(patches, regions, mesh.points),
    "\n$EndEntities\n$Nodes\n",
  ];
  return { groups, head };
}

/** Returns one section per name of values at nodes or of elements; the same in both versions of the format. */
export function* dataSections(mesh: WrittenMesh): Generator<Part, void> {
  for (const [name, data] of mesh.nodeData) {
    const { components, values } = data;
    const hasValues = (node: number) =>
      !values.subarray(components * node, components * (node + 1)).every(Number.isNaN);
    const count = values.length / components;
    let rows = 0;
    yield* stepwise(count, (node) => (rows += hasValues(node) ? 1 : 0));
    const rowOf = (node: number) => (hasValues(node) ? node : undefined);
    yield* section("NodeData", name, data, { count, rows, rowOf });
  }
  // Every element has a row, in the order of the file: meshio passes over the tags.
  const cellData = yield* cellDataOf(mesh);
  const order = cellData.size > 0 ? yield* cellsByGroup(mesh) : new Uint32Array();
  const rows = { count: order.length, rows: order.length, rowOf: (element: number) => order[element] };
  for (const [name, data] of cellData) yield* section("ElementData", name, data, rows);
}

/** The nodes or elements of a section. */
interface DataRows {
  /** Number of all nodes or elements, and of those in the section. */
  readonly count: number;
  readonly rows: number;
  /** Returns which values belong to a node or element, whose tag is its index plus 1; undefined if it is left out. */
  readonly rowOf: (index: number) => number | undefined;
}

function* section(
  word: "NodeData" | "ElementData",
  name: string,
  { components, values }: NodeData,
  { count, rows, rowOf }: DataRows,
): Generator<Part, void> {
  // One name, one time, and three numbers: time step, values per row, rows.
  const title = `"${name.replace(/["\r\n]/g, "'")}"`;
  yield `$${word}\n1\n${title}\n1\n0\n3\n0\n${components}\n${rows}\n`;
  const width = 4 + 8 * components;
  yield* inPieces(count, (begin, end) => {
    const view = new DataView(new ArrayBuffer(width * (end - begin)));
    let at = 0;
    for (let index = begin; index < end; index++) {
      const row = rowOf(index);
      if (row === undefined) continue;
      view.setInt32(at, index + 1, IS_LITTLE_ENDIAN);
      for (let i = 0; i < components; i++) {
        view.setFloat64(at + 4 + 8 * i, values[components * row + i] ?? NaN, IS_LITTLE_ENDIAN);
      }
      at += width;
    }
    return new Uint8Array(view.buffer, 0, at);
  });
  yield `\n$End${word}\n`;
}

/** Returns the section with the names of patches and regions. */
export function physicalNames(groups: readonly Group[]): string {
  const lines = groups.map(({ kind, tag, name }) => `${kind.dimension} ${tag} "${name}"\n`);
  return `$PhysicalNames\n${groups.length}\n${lines.join("")}$EndPhysicalNames\n`;
}

function* entities(
  patches: readonly Group[],
  regions: readonly Group[],
  points: Float64Array,
): Generator<Part, void> {
  yield widened([0, 0, patches.length, regions.length]);
  for (const { tag, nodes } of [...patches, ...regions]) {
    const box = yield* boundingBox(nodes, points);
    // List no bounding entities: solvers do not need them, and a free surface has none.
    yield [Int32Array.of(tag), box, widened([1]), Int32Array.of(tag), widened([0])];
  }
}

/** Lowest x y z, highest x y z. */
function* boundingBox(nodes: Uint32Array, points: Float64Array): Steps<Float64Array> {
  const box = Float64Array.of(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity);
  yield* stepwise(nodes.length, (i) => {
    for (let axis = 0; axis < 3; axis++) {
      const value = points[3 * (nodes[i] ?? 0) + axis] ?? 0;
      box[axis] = Math.min(box[axis] ?? 0, value);
      box[axis + 3] = Math.max(box[axis + 3] ?? 0, value);
    }
  });
  return box;
}

/**
 * Puts all nodes into one block of the last entity; tags count from 1 in the order of the mesh. Their positions come after these parts.
 */
export function nodeTags(count: number, groups: readonly Group[]): Part[] {
  const owner = groups.at(-1);
  if (owner === undefined || count === 0) return [widened([0, 0, 0, 0])];
  return [
    widened([1, count, 1, count]),
    Int32Array.of(owner.kind.dimension, owner.tag, 0),
    widened([count]),
    inPieces(count, (begin, end) =>
      widened(Uint32Array.from({ length: end - begin }, (_, i) => begin + i + 1)),
    ),
  ];
}

/** Returns the indices of an element's nodes in Gmsh's order. */
export function gmshOrder({ nodes, dimension }: ElementKind): readonly number[] {
  const order = Array.from({ length: nodes }, (_, i) => i);
  return dimension === 3 && nodes === 10 ? [...order.slice(0, 8), 9, 8] : order;
}

function* elements(groups: readonly Group[]): Generator<Part, void> {
  yield elementCount(groups.map(countIn));
  let tag = 1;
  for (const group of groups) {
    yield entityElements(group, countIn(group));
    yield elementRows(group, group.nodes, tag);
    tag += countIn(group);
  }
}

/** Returns the number of elements of a group. */
export const countIn = ({ kind, nodes }: Group): number => nodes.length / kind.nodes;

/** Returns what comes before all elements. `counts`: per group. */
export function elementCount(counts: readonly number[]): Part {
  const total = counts.reduce((sum, count) => sum + count, 0);
  return widened([counts.length, total, Math.min(1, total), total]);
}

/** Returns what comes before the elements of a group. */
export const entityElements = ({ kind, tag }: Group, count: number): Part => [
  Int32Array.of(kind.dimension, tag, kind.type),
  widened([count]),
];

/** Returns the rows of elements of a group whose tags count from `firstTag`. */
export function elementRows({ kind }: Group, nodes: Uint32Array, firstTag: number): Part {
  const order = gmshOrder(kind);
  return inPieces(nodes.length / kind.nodes, (begin, end) => {
    const rows = new Uint32Array((kind.nodes + 1) * (end - begin));
    for (let e = begin, out = 0; e < end; e++) {
      rows[out++] = firstTag + e;
      for (const i of order) rows[out++] = (nodes[kind.nodes * e + i] ?? 0) + 1;
    }
    return widened(rows);
  });
}
