/**
 * Writes Medit `.mesh` files (text): the tetrahedra with their region as reference, and the triangles of the
 * boundary with their patch as reference. Comments hold the names. Values at the nodes are in a `.sol` file beside it.
 */
import type { MeshGroup, Mesh } from "../mesh/mesh.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { allNameLines } from "./name-lines.js";
import { coordinates, fromOne, numberRows } from "./number-rows.js";

/** Returns the bytes of a Medit file. */
export function writeMedit(mesh: Mesh, note: Note): Part[] {
  const { points } = mesh;
  return [
    "MeshVersionFormatted 2\n\nDimension 3\n\n",
    ...allNameLines(mesh, note).map((line) => `# ${line}\n`),
    `Vertices\n${points.length / 3}\n`,
    numberRows(points, 3, (row) => `${coordinates(row)} 0`),
    ...elements("Triangles", mesh.triangles, 3, mesh.trianglePatch, mesh.patches),
    ...elements("Tetrahedra", mesh.tetrahedra, 4, mesh.tetrahedronRegion, mesh.regions),
    "\nEnd\n",
  ];
}

/** Each line has the corners, counted from 1, and the reference. */
function elements(
  name: string,
  nodes: Uint32Array,
  width: number,
  owners: Uint32Array,
  groups: readonly MeshGroup[],
): Part[] {
  return [
    `\n${name}\n${nodes.length / width}\n`,
    numberRows(nodes, width, (row, e) => `${fromOne(row)} ${groups[owners[e] ?? 0]?.tag ?? 0}`),
  ];
}
