/**
 * Legacy VTK files, which nearly every program that knows VTK reads: as VTU an unstructured grid of the
 * tetrahedra and the boundary's triangles with `region` and `patch` as cell data; binary, which in this
 * format is high byte first. Names are in the title, where all of them fit.
 */
import { bigEndianDoubles, bigEndianInts, joinBytes } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { noteNames, tagsOf } from "./groups.js";
import { allNameLines, NAME_BREAK } from "./name-lines.js";

/** VTK's numbers of linear cells; their node orders are ours. */
const VTK_TRIANGLE = 5;
const VTK_TETRA = 10;

/** The bytes of a legacy VTK file. */
export function writeVtk(mesh: FileMesh, note: Note): Uint8Array<ArrayBuffer> {
  const { connectivity, offsets, types, regions, patches } = vtkCells(mesh);
  const cells = new Int32Array(connectivity.length + offsets.length);
  for (let c = 0, begin = 0; c < offsets.length; begin = offsets[c++] ?? 0) {
    const nodes = connectivity.subarray(begin, offsets[c]);
    cells[begin + c] = nodes.length;
    cells.set(nodes, begin + c + 1);
  }
  return joinBytes([
    `# vtk DataFile Version 3.0\n${title(mesh, note)}\nBINARY\nDATASET UNSTRUCTURED_GRID\n`,
    `POINTS ${mesh.points.length / 3} double\n`,
    bigEndianDoubles(mesh.points),
    `\nCELLS ${types.length} ${cells.length}\n`,
    bigEndianInts(cells),
    `\nCELL_TYPES ${types.length}\n`,
    bigEndianInts(types),
    `\nCELL_DATA ${types.length}\nSCALARS region int 1\nLOOKUP_TABLE default\n`,
    bigEndianInts(regions),
    "\nSCALARS patch int 1\nLOOKUP_TABLE default\n",
    bigEndianInts(patches),
    "\n",
  ]);
}

/** Up to 255 bytes in one line. */
function title(mesh: FileMesh, note: Note): string {
  const cut: string[] = [];
  const lines = allNameLines(mesh, (message) => cut.push(message));
  const text = ["Tetrafront", ...lines].join(NAME_BREAK);
  const isTold = cut.length === 0 && !lines.some((line) => line.includes(NAME_BREAK.trim()));
  if (isTold && new TextEncoder().encode(text).length < 256) return text;
  noteNames(mesh.patches, note);
  noteNames(mesh.regions, note);
  return "Tetrafront";
}

/** The cells of either VTK format. */
export interface VtkCells {
  readonly connectivity: Int32Array;
  /** Where the nodes of each cell end. */
  readonly offsets: Int32Array;
  readonly types: Uint8Array;
  /** Per cell the number of its region or patch; 0 for those of the other kind. */
  readonly regions: Int32Array;
  readonly patches: Int32Array;
}

export function vtkCells(mesh: FileMesh): VtkCells {
  const { tetrahedra, triangles, tetrahedronRegion, trianglePatch } = mesh;
  const [tets, faces] = [tetrahedra.length / 4, triangles.length / 3];
  const connectivity = new Int32Array(tetrahedra.length + triangles.length);
  connectivity.set(tetrahedra);
  connectivity.set(triangles, tetrahedra.length);
  const [regionTags, patchTags] = [tagsOf(mesh.regions), tagsOf(mesh.patches)];
  const regions = new Int32Array(tets + faces);
  tetrahedronRegion.forEach((region, t) => (regions[t] = regionTags[region] ?? 0));
  const patches = new Int32Array(tets + faces);
  trianglePatch.forEach((patch, t) => (patches[tets + t] = patchTags[patch] ?? 0));
  return {
    connectivity,
    offsets: Int32Array.from({ length: tets + faces }, (_, c) =>
      c < tets ? 4 * (c + 1) : tetrahedra.length + 3 * (c + 1 - tets),
    ),
    types: new Uint8Array(tets + faces).fill(VTK_TETRA, 0, tets).fill(VTK_TRIANGLE, tets),
    regions,
    patches,
  };
}
