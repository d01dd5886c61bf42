/** Writes OBJ (text): the boundary with one group per patch; the material has the same name. */
import type { Mesh } from "../mesh/mesh.js";
import { boundaryOf } from "./boundary.js";
import type { Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { patchGroups } from "./groups.js";
import { coordinates, fromOne, numberRows } from "./number-rows.js";

/** Returns the bytes of an OBJ file. The triangles are sorted by patch. */
export function* writeObj(mesh: Mesh, note: Note): Generator<Part, void> {
  const surface = yield* boundaryOf(mesh);
  yield [
    "# Tetrafront\n",
    numberRows(surface.points, 3, (row) => `v ${coordinates(row)}`),
    ...(yield* patchGroups(surface, { toPlain: (name) => name.replace(/\s+/g, "_"), note })).flatMap(
      ({ name, nodes }) => [
        `g ${name}\nusemtl ${name}\n`,
        numberRows(nodes, 3, (row) => `f ${fromOne(row)}`),
      ],
    ),
  ];
}
