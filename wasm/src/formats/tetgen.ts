/**
 * TetGen's three files, as text: `.node` with the points, `.ele` with the tetrahedra and their region as
 * attribute, `.face` with the boundary's triangles and their patch as marker. Numbers count from 1; comments tell names.
 */
import { zipSync, type Zippable } from "fflate";

import { BREATH, joinBytes, type Part } from "./bytes.js";
import type { FileParts, Note } from "./file-format.js";
import type { FileGroup, FileMesh } from "./file-mesh.js";
import { nameLines } from "./name-lines.js";
import { coordinates, numberRows } from "./number-rows.js";

/** So that the zip has the same bytes whenever it is made; the first day that a zip can name. */
const MADE = new Date(1980, 0, 1);

/** Three files of one stem. */
export function writeTetgen(mesh: FileMesh, fileName: string, note: Note): readonly FileParts[] {
  const stem = fileName.replace(/\.[^.]*$/, "");
  return [
    { fileName: `${stem}.node`, parts: nodes(mesh) },
    { fileName: `${stem}.ele`, parts: elements(mesh, note) },
    { fileName: `${stem}.face`, parts: faces(mesh, note) },
  ];
}

/** The three files in one zip. */
export function* writeTetgenZip(mesh: FileMesh, note: Note, fileName: string): Generator<Part, void> {
  const [base = ""] = /[^/\\]*$/.exec(fileName) ?? [];
  const files = writeTetgen(mesh, `${base.replace(/(\.tetgen)?\.zip$/i, "")}.node`, note);
  const held: Zippable = {};
  for (const file of files) {
    held[file.fileName] = joinBytes(file.parts);
    yield BREATH;
  }
  yield zipSync(held, { mtime: MADE });
}

function nodes({ points }: FileMesh): Part[] {
  return [
    `# points\n${points.length / 3} 3 0 0\n`,
    numberRows(points, 3, (row, i) => `${i + 1} ${coordinates(row)}`),
  ];
}

function elements(mesh: FileMesh, note: Note): Part[] {
  const { tetrahedra, tetrahedronRegion, regions } = mesh;
  return [
    ...comments("tetrahedra with their region", nameLines("region", mesh, note)),
    `${tetrahedra.length / 4} 4 1\n`,
    rows(tetrahedra, 4, tetrahedronRegion, regions),
  ];
}

function faces(mesh: FileMesh, note: Note): Part[] {
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

/** Number, corners from 1, tag. */
function rows(nodes: Uint32Array, width: number, owners: Uint32Array, groups: readonly FileGroup[]): Part {
  const counted = nodes.map((node) => node + 1);
  return numberRows(
    counted,
    width,
    (row, e) => `${e + 1} ${row.join(" ")} ${groups[owners[e] ?? 0]?.tag ?? 0}`,
  );
}
