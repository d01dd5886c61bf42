/**
 * Writes Gmsh MSH 2.2, binary, for older programs. Every element has its patch or region as physical group and as
 * entity; the groups carry the names.
 */
import { inPieces } from "../base/steps.js";
import { IS_LITTLE_ENDIAN, type Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { type Group, patchGroups, regionGroups } from "./groups.js";
import type { WrittenMesh } from "./second-order.js";
import { dataSections, GMSH_NAMING, gmshOrder, physicalNames } from "./msh.js";

/** A number, then x y z. */
const NODE_BYTES = 4 + 3 * 8;

/** Returns the bytes of an MSH file. */
export function* writeMsh2(mesh: WrittenMesh, note: Note): Generator<Part, void> {
  const groups = [
    ...(yield* patchGroups(mesh, { ...GMSH_NAMING, note })),
    ...(yield* regionGroups(mesh, { ...GMSH_NAMING, note })),
  ];
  const total = groups.reduce((sum, { kind, nodes }) => sum + nodes.length / kind.nodes, 0);
  yield [
    // 1: binary; 8: bytes of a coordinate. The number 1 that follows shows the byte order.
    "$MeshFormat\n2.2 1 8\n",
    Int32Array.of(1),
    "\n$EndMeshFormat\n",
    physicalNames(groups),
    `$Nodes\n${mesh.points.length / 3}\n`,
    nodes(mesh.points),
    `\n$EndNodes\n$Elements\n${total}\n`,
    elements(groups),
    "\n$EndElements\n",
    dataSections(mesh),
  ];
}

function nodes(points: Float64Array): Part {
  return inPieces(points.length / 3, (begin, end) => {
    const view = new DataView(new ArrayBuffer(NODE_BYTES * (end - begin)));
    for (let i = begin, at = 0; i < end; i++, at += NODE_BYTES) {
      view.setInt32(at, i + 1, IS_LITTLE_ENDIAN);
      for (let axis = 0; axis < 3; axis++) {
        view.setFloat64(at + 4 + 8 * axis, points[3 * i + axis] ?? 0, IS_LITTLE_ENDIAN);
      }
    }
    return view;
  });
}

/** Writes one run per group: type, number of elements and of tags; then number, tags and nodes of each element. */
function* elements(groups: readonly Group[]): Generator<Part, void> {
  let number = 1;
  for (const { kind, tag, nodes: corners } of groups) {
    const count = corners.length / kind.nodes;
    const order = gmshOrder(kind);
    yield Int32Array.of(kind.type, count, 2);
    yield* inPieces(count, (begin, end) => {
      const run = new Int32Array((3 + kind.nodes) * (end - begin));
      for (let e = begin, out = 0; e < end; e++) {
        run[out++] = number++;
        run[out++] = tag;
        run[out++] = tag;
        for (const i of order) run[out++] = (corners[kind.nodes * e + i] ?? 0) + 1;
      }
      return run;
    });
  }
}
