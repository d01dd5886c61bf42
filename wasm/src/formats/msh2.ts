/**
 * Gmsh MSH 2.2, binary, which older programs read: every element has its patch or region as physical group
 * and as entity; the groups carry the names.
 */
import { IS_LITTLE_ENDIAN, type Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { patchGroups, regionGroups, type Group } from "./groups.js";
import { GMSH_NAMING, nodeDataSections, physicalNames } from "./msh.js";

/** A number, then x y z. */
const NODE_BYTES = 4 + 3 * 8;

/** The bytes of an MSH file. */
export function writeMsh2(mesh: FileMesh, note: Note): Part[] {
  const groups = [
    ...patchGroups(mesh, { ...GMSH_NAMING, note }),
    ...regionGroups(mesh, { ...GMSH_NAMING, note }),
  ];
  const total = groups.reduce((sum, { kind, nodes }) => sum + nodes.length / kind.nodes, 0);
  return [
    // 1: binary, 8: bytes of a coordinate; the number 1 that follows tells the byte order.
    "$MeshFormat\n2.2 1 8\n",
    Int32Array.of(1),
    "\n$EndMeshFormat\n",
    physicalNames(groups),
    `$Nodes\n${mesh.points.length / 3}\n`,
    nodes(mesh.points),
    `\n$EndNodes\n$Elements\n${total}\n`,
    ...elements(groups),
    "\n$EndElements\n",
    ...nodeDataSections(mesh),
  ];
}

function nodes(points: Float64Array): DataView {
  const count = points.length / 3;
  const view = new DataView(new ArrayBuffer(NODE_BYTES * count));
  for (let i = 0; i < count; i++) {
    view.setInt32(NODE_BYTES * i, i + 1, IS_LITTLE_ENDIAN);
    for (let axis = 0; axis < 3; axis++) {
      view.setFloat64(NODE_BYTES * i + 4 + 8 * axis, points[3 * i + axis] ?? 0, IS_LITTLE_ENDIAN);
    }
  }
  return view;
}

/** One run per group: type, number of elements and of tags, then number, tags and nodes of each. */
function elements(groups: readonly Group[]): Int32Array[] {
  let number = 1;
  return groups.map(({ kind, tag, nodes: corners }) => {
    const count = corners.length / kind.nodes;
    const run = new Int32Array(3 + (3 + kind.nodes) * count);
    run.set([kind.type, count, 2]);
    for (let e = 0, out = 3; e < count; e++) {
      run[out++] = number++;
      run[out++] = tag;
      run[out++] = tag;
      for (let i = 0; i < kind.nodes; i++) run[out++] = (corners[kind.nodes * e + i] ?? 0) + 1;
    }
    return run;
  });
}
