/**
 * Medit `.mesh` files, as text: the tetrahedra with their region as reference, and the triangles of the
 * boundary with their patch as reference; references count from 1, and comments tell the names.
 */
import { joinBytes } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { tagsOf } from "./groups.js";
import { allNameLines } from "./name-lines.js";
import { coordinates, numberRows } from "./number-rows.js";

/** The bytes of a Medit file. */
export function writeMedit(mesh: FileMesh, note: Note): Uint8Array<ArrayBuffer> {
  const { points } = mesh;
  const [patchTags, regionTags] = [tagsOf(mesh.patches), tagsOf(mesh.regions)];
  return joinBytes([
    "MeshVersionFormatted 2\n\nDimension 3\n\n",
    ...allNameLines(mesh, note).map((line) => `# ${line}\n`),
    `Vertices\n${points.length / 3}\n`,
    ...numberRows(points, 3, (row) => `${coordinates(row)} 0`),
    ...elements("Triangles", mesh.triangles, 3, mesh.trianglePatch, patchTags),
    ...elements("Tetrahedra", mesh.tetrahedra, 4, mesh.tetrahedronRegion, regionTags),
    "\nEnd\n",
  ]);
}

/** Corners from 1, then the reference. */
function elements(
  name: string,
  nodes: Uint32Array,
  width: number,
  owners: Uint32Array,
  tags: readonly number[],
): string[] {
  const counted = nodes.map((node) => node + 1);
  return [
    `\n${name}\n${nodes.length / width}\n`,
    ...numberRows(counted, width, (row, e) => `${row.join(" ")} ${tags[owners[e] ?? 0] ?? 0}`),
  ];
}
