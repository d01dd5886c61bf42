/**
 * Writes PLY (text): points and triangles; if there are several patches, each triangle has the number and colour of
 * its patch. Text, because Gmsh reads no binary PLY, and meshio reads no face properties in binary files.
 */
import type { Mesh } from "../mesh/mesh.js";
import { boundaryOf, colorsOf } from "./boundary.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { nameLines } from "./name-lines.js";
import { coordinates, numberRows } from "./number-rows.js";

/** Returns the bytes of a PLY file. */
export function* writePly(mesh: Mesh, note: Note): Generator<Part, void> {
  const { points, triangles, trianglePatch, patches } = yield* boundaryOf(mesh);
  const hasPatches = patches.length > 1;
  const lineEnds = colorsOf(mesh).map(
    (color, p) => ` ${patches[p]?.tag ?? 0} ${color.map((value) => Math.round(255 * value)).join(" ")}`,
  );
  const header = [
    "ply\nformat ascii 1.0",
    ...nameLines("patch", mesh, note).map((line) => `comment ${line}`),
    `element vertex ${points.length / 3}\nproperty double x\nproperty double y\nproperty double z`,
    `element face ${triangles.length / 3}\nproperty list uchar int vertex_indices`,
    ...(hasPatches ? ["property int patch"] : []),
    ...(hasPatches ? ["red", "green", "blue"].map((part) => `property uchar ${part}`) : []),
    "end_header\n",
  ];
  yield [
    header.join("\n"),
    numberRows(points, 3, (row) => coordinates(row)),
    numberRows(
      triangles,
      3,
      (row, t) => `3 ${row.join(" ")}${hasPatches ? lineEnds[trianglePatch[t] ?? 0] : ""}`,
    ),
  ];
}
