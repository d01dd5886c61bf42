/**
 * Writes TetGen's three files (text): `.node` with the points, `.ele` with the tetrahedra and their region as
 * attribute, and `.face` with the boundary's triangles and their patch as marker. Numbers count from 1; comments
 * hold names.
 */
import type { MeshGroup, Mesh } from "../mesh/mesh.js";
import type { Part } from "./bytes.js";
import type { FileParts, Note } from "./file-format.js";
import { nameLines } from "./name-lines.js";
import { coordinates, fromOne, numberRows } from "./number-rows.js";
import { zipped } from "./zip.js";

/** Returns three files with the same stem. */
export function writeTetgen(mesh: Mesh, fileName: string, note: Note): readonly FileParts[] {
  const stem = fileName.replace(/\.[^.]*$/, "");
  return [
    { fileName: `${stem}.node`, parts: nodes(mesh) },
    { fileName: `${stem}.ele`, parts: elements(mesh, note) },
    { fileName: `${stem}.face`, parts: faces(mesh, note) },
  ];
}

/** Returns the three files in one zip. */
export function* writeTetgenZip(mesh: Mesh, note: Note, fileName: string): Generator<Part, void> {
  const [base = ""] = /[^/\\]*$/.exec(fileName) ?? [];
  const files = writeTetgen(mesh, `${base.replace(/(\.tetgen)?\.zip$/i, "")}.node`, note);
  yield* zipped(files);
}

function nodes({ points }: Mesh): Part[] {
  return [
    `# points\n${points.length / 3} 3 0 0\n`,
    numberRows(points, 3, (row, i) => `${i + 1} ${coordinates(row)}`),
  ];
}

function elements(mesh: Mesh, note: Note): Part[] {
  const { tetrahedra, tetrahedronRegion, regions } = mesh;
  return [
    ...comments("tetrahedra with their region", nameLines("region", mesh, note)),
    `${tetrahedra.length / 4} 4 1\n`,
    rows(tetrahedra, 4, tetrahedronRegion, regions),
  ];
}

function faces(mesh: Mesh, note: Note): Part[] {
  const { triangles, trianglePatch, patches } = mesh;
  return [
    ...comments("triangles with their patch", nameLines("patch", mesh, note)),
    `${triangles.length / 3} 1\n`,
    rows(triangles, 3, trianglePatch, patches),
  ];
}

function comments(...lines: readonly (string | readonly string[])[]): string[] {
  return lines.flat().map((line) => `# ${line}\n`);
}

/** Each line has the number, the corners counted from 1, and the tag. */
function rows(nodes: Uint32Array, width: number, owners: Uint32Array, groups: readonly MeshGroup[]): Part {
  return numberRows(nodes, width, (row, e) => `${e + 1} ${fromOne(row)} ${groups[owners[e] ?? 0]?.tag ?? 0}`);
}
