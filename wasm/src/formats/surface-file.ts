/** Surfaces from files: the triangles of a mesh file, welded. */
import { plural } from "../base/plural.js";
import { ReadFailure } from "./read-result.js";
import type { SurfaceInput } from "../api/types.js";
import { boundaryOf } from "./boundary.js";
import type { FileGroup, FileMesh } from "./file-mesh.js";
import { surfaceRegionsOf, type SurfaceRegions } from "./region-names.js";
import { stepwise, type Steps } from "./steps.js";
import { weldPoints } from "./weld.js";

export interface SurfaceFile extends SurfaceInput {
  /** Per triangle: position in `patches`. */
  readonly trianglePatch: Uint32Array;
  /** Tags, colours, solids or groups of the file; one patch where it tells none. */
  readonly patches: readonly FileGroup[];
  /** Regions that the file tells of, by tetrahedra or, in Gmsh's files, by volumes; undefined where it does not. */
  readonly surfaceRegions?: SurfaceRegions | undefined;
  /** Names of regions of which the file does not tell where they are, and which are lost therefore. */
  readonly unplacedRegions?: readonly string[] | undefined;
  /** What else of the file is passed over, in sentences. */
  readonly notes?: readonly string[] | undefined;
  /** So many times the file lists a triangle again; it is held once, in its first group. */
  readonly repeatedTriangles?: number | undefined;
}

/** The triangles of a file, and of its points those they use. Throws a ReadFailure where there are none. */
export function* surfaceOf(mesh: FileMesh): Steps<SurfaceFile> {
  if (mesh.triangles.length === 0) throw noTriangles(mesh.tetrahedra.length / 4);
  const { trianglePatch, patches, notes, unplacedRegions, repeatedTriangles = 0 } = mesh;
  const surfaceRegions = yield* surfaceRegionsOf(mesh);
  return {
    ...(yield* exactlyWelded(yield* boundaryOf(mesh))),
    trianglePatch,
    patches,
    ...(surfaceRegions && { surfaceRegions }),
    ...(unplacedRegions && { unplacedRegions }),
    ...(notes && { notes }),
    ...(repeatedTriangles > 0 && { repeatedTriangles }),
  };
}

function* exactlyWelded({ points: given, triangles, isWelded }: FileMesh): Steps<SurfaceInput> {
  if (isWelded === true) return { points: given, triangles };
  const { points, positions } = yield* weldPoints(given);
  const welded = new Uint32Array(triangles.length);
  yield* stepwise(welded.length, (i) => (welded[i] = positions[triangles[i] ?? 0] ?? 0));
  return { points, triangles: welded };
}

function noTriangles(tetrahedra: number): ReadFailure {
  return tetrahedra === 0
    ? new ReadFailure({
        code: "no-triangles",
        message: "the file holds no triangle",
        remedy: "Export the surface as triangles.",
      })
    : new ReadFailure({
        code: "no-triangles",
        message: `the file holds ${plural(tetrahedra, "tetrahedron")} and no triangle; an outside is not taken for a surface`,
        remedy: "Write the boundary's triangles into the file too, or give it as background grid.",
      });
}
