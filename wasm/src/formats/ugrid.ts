/**
 * Writes UGRID (AFLR, FUN3D, Kestrel): the boundary triangles, counter-clockwise seen from outside, with the tag of
 * their patch, and the tetrahedra. The files are text (`.ugrid`) or binary with the high byte first (`.b8.ugrid`).
 * The format has no names and no regions.
 */
import type { Steps } from "../base/steps.js";
import type { Mesh } from "../mesh/mesh.js";
import { bigEndianDoubles, bigEndianInts, type Part } from "./bytes.js";
import type { Note } from "./file-format.js";
import { noteNames } from "./groups.js";
import { coordinates, fromOne, numberRows } from "./number-rows.js";
import { noteRegions, withOuterFaces } from "./outer-faces.js";

/** Returns the bytes of a UGRID file as text. */
export function* writeUgrid(given: Mesh, note: Note): Generator<Part, void> {
  const mesh = yield* boundedMesh(given, note);
  yield [
    `${countsOf(mesh).join(" ")}\n`,
    numberRows(mesh.points, 3, (row) => coordinates(row)),
    numberRows(mesh.triangles, 3, (row) => fromOne(row)),
    numberRows(tagsOfTriangles(mesh), 1, (row) => row.join(" ")),
    numberRows(mesh.tetrahedra, 4, (row) => fromOne(row)),
  ];
}

/** Returns the bytes of a binary UGRID file, high byte first. */
export function* writeUgridBinary(given: Mesh, note: Note): Generator<Part, void> {
  const mesh = yield* boundedMesh(given, note);
  yield [
    bigEndianInts(countsOf(mesh)),
    bigEndianDoubles(mesh.points),
    bigEndianInts(mesh.triangles, 1),
    bigEndianInts(tagsOfTriangles(mesh)),
    bigEndianInts(mesh.tetrahedra, 1),
  ];
}

function boundedMesh(mesh: Mesh, note: Note): Steps<Mesh> {
  noteRegions(mesh, note);
  noteNames(mesh.patches, note);
  return withOuterFaces(mesh, note);
}

/** Nodes, triangles, quadrilaterals, tetrahedra, pyramids, prisms, hexahedra. */
function countsOf({ points, triangles, tetrahedra }: Mesh): number[] {
  return [points.length / 3, triangles.length / 3, 0, tetrahedra.length / 4, 0, 0, 0];
}

function tagsOfTriangles({ trianglePatch, patches }: Mesh): Uint32Array {
  return trianglePatch.map((patch) => patches[patch]?.tag ?? 0);
}
