/**
 * Medit `.mesh` files, as text: the tetrahedra with their region as reference, and the triangles of the
 * boundary with their patch as reference; references count from 1.
 */
import type { MeshResult } from "../types.js";
import { joinBytes } from "./bytes.js";
import { numberRows } from "./number-rows.js";

/** The bytes of a Medit file. A partial mesh is written as far as it goes. */
export function writeMedit(mesh: Pick<MeshResult, "surface" | "volume">): Uint8Array<ArrayBuffer> {
  const { surface, volume } = mesh;
  const points = volume.points.length > 0 ? volume.points : surface.points;
  return joinBytes([
    `MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n${points.length / 3}\n`,
    ...numberRows(points, 3, (row) => `${row.join(" ")} 0`),
    ...elements("Triangles", surface.triangles, 3, surface.trianglePatch),
    ...elements("Tetrahedra", volume.tetrahedra, 4, volume.regions),
    "\nEnd\n",
  ]);
}

/** Corners from 1, then the reference. */
function elements(name: string, nodes: Uint32Array, width: number, references: Uint32Array): string[] {
  const counted = nodes.map((node) => node + 1);
  return [
    `\n${name}\n${nodes.length / width}\n`,
    ...numberRows(counted, width, (row, e) => `${row.join(" ")} ${(references[e] ?? 0) + 1}`),
  ];
}
