/** OFF, as text: the boundary, and, where there are several patches, each triangle with the colour of its own. */
import { boundaryOf, colorsOf } from "./boundary.js";
import { joinBytes } from "./bytes.js";
import type { FileMesh } from "./file-mesh.js";
import { numberRows } from "./number-rows.js";

/** The bytes of an OFF file. */
export function writeOff(mesh: FileMesh): Uint8Array<ArrayBuffer> {
  const { points, triangles, trianglePatch } = boundaryOf(mesh);
  const colors = colorsOf(mesh).map((color) => color.map((value) => Math.round(255 * value)).join(" "));
  const tail = (t: number) => (colors.length > 1 ? ` ${colors[trianglePatch[t] ?? 0] ?? ""}` : "");
  return joinBytes([
    `OFF\n${points.length / 3} ${triangles.length / 3} 0\n`,
    ...numberRows(points, 3, (row) => row.join(" ")),
    ...numberRows(triangles, 3, (row, t) => `3 ${row.join(" ")}${tail(t)}`),
  ]);
}
