/**
 * Writes SU2 meshes (text): the tetrahedra, and one marker per patch with its triangles on the boundary. In names,
 * underscores replace the characters that end or split names in SU2's configuration files. The format cannot store
 * regions and the interfaces between them.
 */
import type { Mesh } from "../mesh/mesh.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { type Naming, patchGroups } from "./groups.js";
import { coordinates, numberRows } from "./number-rows.js";
import { noteRegions, withOuterFaces } from "./outer-faces.js";

/** VTK's cell types, which SU2 uses; its node orders equal ours. */
const VTK_TRIANGLE = 5;
const VTK_TETRA = 10;
/** SU2 exchanges names between processes in buffers of 200 bytes, including a final zero. */
const NAMING: Naming = { toPlain: plainName, maxBytes: 199 };

/** Returns the bytes of an SU2 file. */
export function* writeSu2(mesh: Mesh, note: Note): Generator<Part, void> {
  const { points, tetrahedra } = mesh;
  const markers = yield* patchGroups(yield* withOuterFaces(mesh, note), { ...NAMING, note });
  noteRegions(mesh, note);
  yield [
    `NDIME= 3\nNELEM= ${tetrahedra.length / 4}\n`,
    numberRows(tetrahedra, 4, (row, t) => `${VTK_TETRA} ${row.join(" ")} ${t}`),
    `NPOIN= ${points.length / 3}\n`,
    numberRows(points, 3, (row, i) => `${coordinates(row)} ${i}`),
    `NMARK= ${markers.length}\n`,
    ...markers.flatMap(({ name, nodes }) => [
      `MARKER_TAG= ${name}\nMARKER_ELEMS= ${nodes.length / 3}\n`,
      numberRows(nodes, 3, (row) => `${VTK_TRIANGLE} ${row.join(" ")}`),
    ]),
  ];
}

/**
 * Keeps letters and digits of any script. NONE must not be a name: in a list of markers it means that there is
 * none.
 */
function plainName(name: string): string {
  const plain = name.replace(/[^\p{L}\p{M}\p{N}_.+-]+/gu, "_");
  return plain.toUpperCase() === "NONE" ? `${plain}_` : plain;
}
