/** Surfaces from files: the triangles of a mesh file, welded. */
import { ReadFailure } from "../read-result.js";
import type { SurfaceInput } from "../types.js";
import { boundaryOf } from "./boundary.js";
import type { FileGroup, FileMesh } from "./file-mesh.js";
import { weldWithin } from "./weld-within.js";
import { weldPoints } from "./weld.js";

export interface SurfaceFile extends SurfaceInput {
  /** Per triangle: position in `patches`. */
  readonly trianglePatch: Uint32Array;
  /** Tags, colours, solids or groups of the file; one patch where it tells none. */
  readonly patches: readonly FileGroup[];
  /** What welding within a tolerance has changed beyond equal coordinates. */
  readonly welded: {
    /** Points that became another one. */
    readonly points: number;
    /** Triangles that lost a corner by it and were dropped. */
    readonly triangles: number;
  };
}

/** The triangles of a file, and of its points those they use. Throws a ReadFailure where there are none. */
export function surfaceOf(mesh: FileMesh, weldTolerance = 0): SurfaceFile {
  if (!(Number.isFinite(weldTolerance) && weldTolerance >= 0)) {
    throw new ReadFailure({
      message: `the weld tolerance is ${weldTolerance}`,
      remedy: "Give a finite length from 0, in model units.",
    });
  }
  if (mesh.triangles.length === 0) throw noTriangles(mesh.tetrahedra.length / 4);
  const exact = { ...exactlyWelded(boundaryOf(mesh)), trianglePatch: mesh.trianglePatch };
  const within =
    weldTolerance > 0 ? weldWithin(exact, weldTolerance) : { ...exact, welded: { points: 0, triangles: 0 } };
  return { ...within, patches: mesh.patches };
}

function exactlyWelded({ points: given, triangles, isWelded }: FileMesh): SurfaceInput {
  if (isWelded === true) return { points: given, triangles };
  const { points, positions } = weldPoints(given);
  return { points, triangles: triangles.map((node) => positions[node] ?? 0) };
}

function noTriangles(tetrahedra: number): ReadFailure {
  return tetrahedra === 0
    ? new ReadFailure({ message: "the file holds no triangle", remedy: "Export the surface as triangles." })
    : new ReadFailure({
        message: `the file holds ${tetrahedra} tetrahedra and no triangle; their outside is not taken for a surface`,
        remedy: "Write the boundary's triangles into the file too, or give it as background grid.",
      });
}
