/**
 * Writes OFF (text): the points and triangles of the boundary. Face colours could identify patches, but many
 * programs read three corners per line and reject or garble the rest. Patches are therefore listed in comments at
 * the end.
 */
import type { Mesh } from "../mesh/mesh.js";
import { boundaryOf } from "./boundary.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { faceLines, nameLines } from "./name-lines.js";
import { coordinates, numberRows } from "./number-rows.js";

/** Returns the bytes of an OFF file. */
export function* writeOff(mesh: Mesh, note: Note): Generator<Part, void> {
  const { points, triangles, trianglePatch, patches } = yield* boundaryOf(mesh);
  yield [
    `OFF\n${points.length / 3} ${triangles.length / 3} 0\n`,
    numberRows(points, 3, (row) => coordinates(row)),
    numberRows(triangles, 3, (row) => `3 ${row.join(" ")}`),
    ...[...nameLines("patch", mesh, note), ...faceLines(trianglePatch, patches)].map((line) => `# ${line}\n`),
  ];
}
