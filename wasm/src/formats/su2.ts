/**
 * SU2 meshes, as text: the tetrahedra, and one marker per patch with its triangles on the boundary. A marker's
 * name has underscores for all that ends or splits names in SU2's configurations. Regions and walls between them have no place in the format.
 */
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { patchGroups, type Naming } from "./groups.js";
import { coordinates, numberRows } from "./number-rows.js";
import { noteRegions, withOuterFaces } from "./outer-faces.js";

/** VTK's numbers of cells, which SU2 uses; its node orders are ours. */
const VTK_TRIANGLE = 5;
const VTK_TETRA = 10;
/** SU2 hands names from process to process in 200 bytes, a zero behind them. */
const NAMING: Naming = { plain: plainName, longest: 199 };

/** The bytes of an SU2 file. */
export function* writeSu2(mesh: FileMesh, note: Note): Generator<Part, void> {
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

/** Letters and digits of any script; a list of markers may say NONE for no marker at all. */
function plainName(name: string): string {
  const plain = name.replace(/[^\p{L}\p{M}\p{N}_.+-]+/gu, "_");
  return plain.toUpperCase() === "NONE" ? `${plain}_` : plain;
}
