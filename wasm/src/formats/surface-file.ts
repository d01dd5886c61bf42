/** Surfaces from files: the triangles of a mesh file, welded exactly, those of soups within rounding. */
import { plural } from "../base/plural.js";
import { type Steps, stepwise } from "../base/steps.js";
import type { Mesh, SurfaceInput } from "../mesh/mesh.js";
import { boundaryOf, noVolume } from "./boundary.js";
import { ReadFailure } from "./read-result.js";
import { surfaceRegionsOf } from "./region-names.js";
import { type WeldedByRounding, weldRounding } from "./rounding.js";
import { isSoup } from "./soup.js";
import { weldPoints } from "./weld.js";

/** Returns the triangles of a file with the points they use. Throws a ReadFailure if there are no triangles. */
export function* surfaceOf(mesh: Mesh): Steps<Mesh> {
  if (mesh.triangles.length === 0) throw noTriangles(mesh.tetrahedra.length / 4);
  const { trianglePatch, patches, unit, unlocatedRegions, duplicateTriangles = 0 } = mesh;
  const { regionPoints, trueFaces } = mesh;
  const surfaceRegions = yield* surfaceRegionsOf(mesh);
  const { points, triangles, welded, distance } = yield* withoutNoise(mesh);
  const notes = [...(mesh.notes ?? []), ...(welded > 0 ? [roundingNote(welded, distance)] : [])];
  return {
    points,
    triangles,
    trianglePatch,
    patches,
    ...noVolume(),
    ...(surfaceRegions && { surfaceRegions }),
    ...(unit && { unit }),
    ...(unlocatedRegions && { unlocatedRegions }),
    ...(notes.length > 0 && { notes }),
    ...(regionPoints && { regionPoints }),
    ...(trueFaces && { trueFaces }),
    ...(duplicateTriangles > 0 && { duplicateTriangles }),
  };
}

/** Welds equal points, and in a soup those that differ by rounding. */
function* withoutNoise(mesh: Mesh): Steps<WeldedByRounding> {
  const { points, triangles, tetrahedra, isWelded = false } = mesh;
  const exact = yield* exactlyWelded(yield* boundaryOf(mesh));
  const mayBeSoup = tetrahedra.length === 0 && !isWelded;
  const isLoose = mesh.isSoup ?? (mayBeSoup && (yield* isSoup(triangles, points.length / 3)));
  return isLoose ? yield* weldRounding(exact) : { ...exact, welded: 0, distance: 0 };
}

function roundingNote(welded: number, distance: number): string {
  const words =
    welded === 1
      ? "1 node was welded to another that differs from it only by rounding"
      : `${welded} nodes were welded to others that differ from them only by rounding`;
  return `${words}, by at most ${Number(distance.toPrecision(2))}`;
}

function* exactlyWelded({ points: given, triangles, isWelded }: Mesh): Steps<SurfaceInput> {
  if (isWelded === true) return { points: given, triangles };
  const { points, indices } = yield* weldPoints(given);
  const welded = new Uint32Array(triangles.length);
  yield* stepwise(welded.length, (i) => (welded[i] = indices[triangles[i] ?? 0] ?? 0));
  return { points, triangles: welded };
}

function noTriangles(tetrahedra: number): ReadFailure {
  return tetrahedra === 0
    ? new ReadFailure({
        code: "no-triangles",
        message: "the file contains no triangles",
        remedy: "Export the surface as triangles.",
      })
    : new ReadFailure({
        code: "no-triangles",
        message: `the file contains ${plural(tetrahedra, "tetrahedron")} but no triangles`,
        remedy:
          "Add the triangles of the boundary to the file (`tetrafront convert` extracts them), or use the file as background grid.",
      });
}
