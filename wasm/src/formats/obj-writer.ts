/** OBJ, as text: the boundary with one group per patch, whose name is also the material's. */
import { boundaryOf } from "./boundary.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { patchGroups } from "./groups.js";
import { coordinates, fromOne, numberRows } from "./number-rows.js";

/** The bytes of an OBJ file. The triangles are put in the order of their patches. */
export function* writeObj(mesh: FileMesh, note: Note): Generator<Part, void> {
  const surface = yield* boundaryOf(mesh);
  yield [
    "# Tetrafront\n",
    numberRows(surface.points, 3, (row) => `v ${coordinates(row)}`),
    ...(yield* patchGroups(surface, { plain: (name) => name.replace(/\s+/g, "_"), note })).flatMap(
      ({ name, nodes }) => [
        `g ${name}\nusemtl ${name}\n`,
        numberRows(nodes, 3, (row) => `f ${fromOne(row)}`),
      ],
    ),
  ];
}
