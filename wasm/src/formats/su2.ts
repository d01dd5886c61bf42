/**
 * SU2 meshes, as text: the tetrahedra, and one marker per patch with its triangles. A marker's name has
 * underscores for blanks, for SU2 ends names there. Regions have no place in the format.
 */
import type { MeshResult } from "../types.js";
import { joinBytes } from "./bytes.js";
import { groupsOf, TRIANGLE, type GroupNames } from "./groups.js";
import { numberRows } from "./number-rows.js";

/** VTK's numbers of cells, which SU2 uses; its node orders are ours. */
const VTK_TRIANGLE = 5;
const VTK_TETRA = 10;

/** The bytes of an SU2 file. A partial mesh is written as far as it goes. */
export function writeSu2(
  mesh: Pick<MeshResult, "surface" | "volume">,
  names: GroupNames = {},
): Uint8Array<ArrayBuffer> {
  const { surface, volume } = mesh;
  const points = volume.points.length > 0 ? volume.points : surface.points;
  const plain = names.patches?.map((name) => name.trim().replace(/\s+/g, "_"));
  const markers = groupsOf(TRIANGLE, surface.triangles, surface.trianglePatch, "patch", plain);
  return joinBytes([
    `NDIME= 3\nNELEM= ${volume.tetrahedra.length / 4}\n`,
    ...numberRows(volume.tetrahedra, 4, (row, t) => `${VTK_TETRA} ${row.join(" ")} ${t}`),
    `NPOIN= ${points.length / 3}\n`,
    ...numberRows(points, 3, (row, i) => `${row.join(" ")} ${i}`),
    `NMARK= ${markers.length}\n`,
    ...markers.flatMap(({ name, nodes }) => [
      `MARKER_TAG= ${name.replace(/\s+/g, "_")}\nMARKER_ELEMS= ${nodes.length / 3}\n`,
      ...numberRows(nodes, 3, (row) => `${VTK_TRIANGLE} ${row.join(" ")}`),
    ]),
  ]);
}
