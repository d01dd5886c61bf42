/**
 * OFF, as text: the boundary, points and triangles alone. Colours of faces would tell patches apart, but many
 * programs read three corners and nothing else from a face's line, and refuse or garble the rest: they are told by
 * comments at the end, where nobody else looks.
 */
import { boundaryOf } from "./boundary.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { faceLines, nameLines } from "./name-lines.js";
import { coordinates, numberRows } from "./number-rows.js";

/** The bytes of an OFF file. */
export function* writeOff(mesh: FileMesh, note: Note): Generator<Part, void> {
  const { points, triangles, trianglePatch, patches } = yield* boundaryOf(mesh);
  yield [
    `OFF\n${points.length / 3} ${triangles.length / 3} 0\n`,
    numberRows(points, 3, (row) => coordinates(row)),
    numberRows(triangles, 3, (row) => `3 ${row.join(" ")}`),
    ...[...nameLines("patch", mesh, note), ...faceLines(trianglePatch, patches)].map((line) => `# ${line}\n`),
  ];
}
