/**
 * The boundary as solvers take it: each face of one tetrahedron once, outward, in a patch. Walls between regions, which
 * have an element on either side, are no boundary; nor are triangles without any.
 */
import { plural } from "../base/plural.js";
import type { Note } from "./file-format.js";
import type { FileMesh } from "./file-mesh.js";
import { listed } from "./groups.js";
import { stepwise, type Steps } from "./steps.js";
import { cornersOf, NONE, soundFaces } from "./tet-faces.js";

/** For faces that no patch has, as in a partial mesh. */
export const NAMELESS = "unnamed faces";

/** The mesh with these triangles alone. Throws a MesherError where its elements do not fit together. */
export function* withOuterFaces(mesh: FileMesh, note: Note): Steps<FileMesh> {
  const { tetrahedra, trianglePatch, patches } = mesh;
  const { twin, triangle, faceOfTriangle } = yield* soundFaces(mesh);
  const faces: number[] = [];
  const owners: number[] = [];
  const walls: number[] = [];
  let lost = 0;
  let repeated = 0;
  yield* stepwise(faceOfTriangle.length, (t) => {
    const face = faceOfTriangle[t] ?? NONE;
    if (face === NONE) lost++;
    else if (triangle[face] !== t) repeated++;
    else if (twin[face] !== NONE) walls.push(t);
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
  noteWalls(mesh, walls, note);
  noteLoose(lost, note);
  noteRepeated(repeated, note);
  if (faces.length > named) noteNameless(faces.length - named, NAMELESS, note);
  const triangles = new Uint32Array(3 * faces.length);
  yield* stepwise(faces.length, (t) => triangles.set(cornersOf(tetrahedra, faces[t] ?? 0), 3 * t));
  const lastTag = patches.reduce((most, { tag }) => Math.max(most, tag), 0);
  return {
    ...mesh,
    triangles,
    trianglePatch: Uint32Array.from(owners),
    patches: [...patches, { name: NAMELESS, tag: lastTag + 1 }],
  };
}

function noteWalls({ trianglePatch, patches }: FileMesh, walls: readonly number[], note: Note): void {
  if (walls.length === 0) return;
  const names = new Set(walls.map((t) => `"${patches[trianglePatch[t] ?? 0]?.name ?? ""}"`));
  note(
    `left out: ${plural(walls.length, "triangle")} with a tetrahedron on either side, of ${listed([...names])}, ` +
      "for the format has faces on the boundary alone",
  );
}

export function noteLoose(count: number, note: Note): void {
  if (count > 0) note(`left out: ${plural(count, "triangle")} on no tetrahedron`);
}

export function noteRepeated(count: number, note: Note): void {
  if (count > 0) note(`left out: ${plural(count, "triangle")} in the place of another`);
}

export function noteNameless(count: number, patch: string, note: Note): void {
  note(`put into "${patch}": ${plural(count, "face")} of one tetrahedron and no patch`);
}

export function noteRegions({ regions }: FileMesh, note: Note): void {
  if (regions.length > 1) note(`the ${regions.length} regions are told apart no more: the format has none`);
}
