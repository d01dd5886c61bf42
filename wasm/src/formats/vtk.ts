/**
 * Legacy VTK files, which nearly every program that knows VTK reads: an unstructured grid of the
 * tetrahedra with the region as cell data; binary, which in this format is high byte first.
 */
import { joinBytes } from "./bytes.js";
import type { FileMesh } from "./file-mesh.js";

/** VTK's number for a linear tetrahedron; its node order is ours. */
const VTK_TETRA = 10;

/** The bytes of a legacy VTK file. */
export function writeVtk(mesh: FileMesh): Uint8Array<ArrayBuffer> {
  const { points, tetrahedra, tetrahedronRegion: regions } = mesh;
  const count = tetrahedra.length / 4;
  const cells = new Uint32Array(5 * count);
  for (let t = 0; t < count; t++) {
    cells[5 * t] = 4;
    cells.set(tetrahedra.subarray(4 * t, 4 * t + 4), 5 * t + 1);
  }
  return joinBytes([
    "# vtk DataFile Version 3.0\nTetrafront\nBINARY\nDATASET UNSTRUCTURED_GRID\n",
    `POINTS ${points.length / 3} double\n`,
    bigEndianDoubles(points),
    `\nCELLS ${count} ${cells.length}\n`,
    bigEndianInts(cells),
    `\nCELL_TYPES ${count}\n`,
    bigEndianInts(new Uint32Array(count).fill(VTK_TETRA)),
    `\nCELL_DATA ${count}\nSCALARS region int 1\nLOOKUP_TABLE default\n`,
    bigEndianInts(regions),
    "\n",
  ]);
}

function bigEndianDoubles(values: Float64Array): DataView {
  const view = new DataView(new ArrayBuffer(8 * values.length));
  values.forEach((value, i) => view.setFloat64(8 * i, value));
  return view;
}

function bigEndianInts(values: Uint32Array): DataView {
  const view = new DataView(new ArrayBuffer(4 * values.length));
  values.forEach((value, i) => view.setUint32(4 * i, value));
  return view;
}
