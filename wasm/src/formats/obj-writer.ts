/** OBJ, as text: the boundary with one group per patch, whose name is also the material's. */
import { boundaryOf } from "./boundary.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { patchGroups } from "./groups.js";
import { coordinates, numberRows } from "./number-rows.js";

/** The bytes of an OBJ file. The triangles are put in the order of their patches. */
export function writeObj(mesh: FileMesh, note: Note): Part[] {
  const surface = boundaryOf(mesh);
  return [
    "# Tetrafront\n",
    numberRows(surface.points, 3, (row) => `v ${coordinates(row)}`),
    ...patchGroups(surface, { plain: (name) => name.replace(/\s+/g, "_"), note }).flatMap(
      ({ name, nodes }) => [
        `g ${name}\nusemtl ${name}\n`,
        numberRows(
          nodes.map((node) => node + 1),
          3,
          (row) => `f ${row.join(" ")}`,
        ),
      ],
    ),
  ];
}
