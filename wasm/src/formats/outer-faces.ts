/**
 * Boundary as solvers need it: each face of exactly one tetrahedron once, facing outward, in a patch. Interfaces,
 * with an element on each side, and triangles without an element are left out.
 */
import { plural } from "../base/plural.js";
import { type Steps, stepwise } from "../base/steps.js";
import type { Mesh } from "../mesh/mesh.js";
import type { Note } from "./file-format.js";
import { listed } from "./groups.js";
import { cornersOf, NONE, validFaces } from "./tet-faces.js";

/** Name of the patch for boundary faces without a triangle, as in a partial mesh. */
export const UNNAMED_FACES = "unnamed faces";

/**
 * Returns the mesh with the boundary faces as its triangles. Throws a MesherError if its elements do not fit
 * together.
 */
export function* withOuterFaces(mesh: Mesh, note: Note): Steps<Mesh> {
  const { tetrahedra, trianglePatch, patches } = mesh;
  const { twin, triangle, faceOfTriangle } = yield* validFaces(mesh);
  const faces: number[] = [];
  const owners: number[] = [];
  const interfaces: number[] = [];
  let lost = 0;
  let repeated = 0;
  yield* stepwise(faceOfTriangle.length, (t) => {
    const face = faceOfTriangle[t] ?? NONE;
    if (face === NONE) lost++;
    else if (triangle[face] !== t) repeated++;
    else if (twin[face] !== NONE) interfaces.push(t);
    else {
      faces.push(face);
      owners.push(trianglePatch[t] ?? 0);
    }
  });
  const named = faces.length;
  yield* stepwise(twin.length, (face) => {
    if (twin[face] !== NONE || triangle[face] !== NONE) return;
    faces.push(face);
    owners.push(patches.length);
  });
  noteInterfaces(mesh, interfaces, note);
  noteFreeTriangles(lost, note);
  noteDuplicates(repeated, note);
  if (faces.length > named) noteUnnamedFaces(faces.length - named, UNNAMED_FACES, note);
  const triangles = new Uint32Array(3 * faces.length);
  yield* stepwise(faces.length, (t) => triangles.set(cornersOf(tetrahedra, faces[t] ?? 0), 3 * t));
  const lastTag = patches.reduce((most, { tag }) => Math.max(most, tag), 0);
  return {
    ...mesh,
    triangles,
    trianglePatch: Uint32Array.from(owners),
    patches: [...patches, { name: UNNAMED_FACES, tag: lastTag + 1 }],
  };
}

function noteInterfaces({ trianglePatch, patches }: Mesh, interfaces: readonly number[], note: Note): void {
  if (interfaces.length === 0) return;
  const names = new Set(interfaces.map((t) => `"${patches[trianglePatch[t] ?? 0]?.name ?? ""}"`));
  note(
    `left out: ${plural(interfaces.length, "triangle")} with a tetrahedron on both sides, of ${listed([...names])}: ` +
      "the format stores boundary faces only",
  );
}

export function noteFreeTriangles(count: number, note: Note): void {
  if (count > 0) note(`left out: ${plural(count, "triangle")} without a tetrahedron`);
}

export function noteDuplicates(count: number, note: Note): void {
  if (count > 0) note(`left out: ${plural(count, "duplicate triangle")}`);
}

export function noteUnnamedFaces(count: number, patch: string, note: Note): void {
  note(`added to "${patch}": ${plural(count, "boundary face")} without a patch`);
}

export function noteRegions({ regions }: Mesh, note: Note): void {
  if (regions.length > 1) note(`the ${regions.length} regions are merged: the format cannot store regions`);
}
