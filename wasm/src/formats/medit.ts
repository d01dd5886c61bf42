/**
 * Medit `.mesh` files, as text: the tetrahedra with their region as reference, and the triangles of the
 * boundary with their patch as reference; references count from 1.
 */
import type { MeshResult } from "../types.js";
import { joinBytes } from "./bytes.js";

/** Lines are joined in pieces of so many: one text for all would exceed the longest string. */
const LINES_PER_PIECE = 1 << 16;

/** The bytes of a Medit file. A partial mesh is written as far as it goes. */
export function writeMedit(mesh: Pick<MeshResult, "surface" | "volume">): Uint8Array<ArrayBuffer> {
  const { surface, volume } = mesh;
  const points = volume.points.length > 0 ? volume.points : surface.points;
  return joinBytes([
    "MeshVersionFormatted 2\n\nDimension 3\n",
    // The shortest decimals that give the same doubles back.
    ...section("Vertices", points, 3, 0, undefined),
    ...section("Triangles", surface.triangles, 3, 1, surface.trianglePatch),
    ...section("Tetrahedra", volume.tetrahedra, 4, 1, volume.regions),
    "\nEnd\n",
  ]);
}

/** One row per item of `width` numbers, `first` added to each, and its reference. */
function section(
  name: string,
  values: Float64Array | Uint32Array,
  width: number,
  first: number,
  references: Uint32Array | undefined,
): string[] {
  const count = values.length / width;
  const pieces = [`\n${name}\n${count}\n`];
  for (let begin = 0; begin < count; begin += LINES_PER_PIECE) {
    const rows = Array.from({ length: Math.min(LINES_PER_PIECE, count - begin) }, (_, i) => {
      const row = begin + i;
      const numbers = Array.from(values.subarray(width * row, width * (row + 1)), (value) => value + first);
      return `${numbers.join(" ")} ${references === undefined ? 0 : (references[row] ?? 0) + 1}\n`;
    });
    pieces.push(rows.join(""));
  }
  return pieces;
}
