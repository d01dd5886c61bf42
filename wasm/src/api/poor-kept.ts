/** Triangles that were kept, and beside which the elements are poor: fit triangles that are large for the thickness of the body. */
import { short } from "../base/short.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { MeshResult } from "../mesh/report.js";

/** Share of poor elements above which other triangles are tried. */
const MAX_POOR = 0.01;

/** Mean radius ratio below which other triangles are tried: elements much wider than the body is thick. */
const MIN_RATIO = 0.35;

/** Number of tetrahedra above which nobody expects the mesh of given triangles to grow unasked. */
const MAX_TETRAHEDRA = 200_000;

/** Figures of a finished mesh by which two are compared. */
export interface ElementShapes {
  /** Number of poor elements / number of all. */
  readonly poorShare: number;
  /** Mean of 3 × inradius / circumradius. */
  readonly meanRadiusRatio: number;
  /** Smallest dihedral angle in degrees. */
  readonly smallestAngle: number;
}

/** Returns the shapes of the elements; undefined if the mesh is not finished. */
function shapesOf({ report }: MeshResult): ElementShapes | undefined {
  const { status, tetrahedra, quality, radiusRatio, dihedral } = report;
  if (status !== "done" || tetrahedra === 0) return undefined;
  return {
    poorShare: quality.poor.count / tetrahedra,
    meanRadiusRatio: radiusRatio.mean,
    smallestAngle: dihedral.min,
  };
}

/**
 * Returns the shapes of a mesh if they are poor and other triangles may help: no elements can open the wedges of a body, and good
 * ones in a very thin body are too many to be made unasked.
 */
export function helpedByOthers(kept: MeshResult): ElementShapes | undefined {
  const shapes = shapesOf(kept);
  if (shapes === undefined) return undefined;
  const { tetrahedra, quality } = kept.report;
  const { count, inWedges, goodTetrahedra } = quality.poor;
  const isPoor = count - inWedges > MAX_POOR * tetrahedra || shapes.meanRadiusRatio < MIN_RATIO;
  return isPoor && goodTetrahedra <= MAX_TETRAHEDRA ? shapes : undefined;
}

/** Returns whether a mesh is finished, and its elements have better shapes than those of another. */
export function isBetter(made: MeshResult, kept: MeshResult): boolean {
  const [one, other] = [shapesOf(made), shapesOf(kept)];
  if (one === undefined || other === undefined) return false;
  return one.poorShare <= other.poorShare && one.meanRadiusRatio > other.meanRadiusRatio;
}

/** Says why triangles that were fit were replaced. `keep`: how to keep them. */
export function poorNote({ smallestAngle, meanRadiusRatio }: ElementShapes, keep: string): Diagnostic {
  const figures = `smallest dihedral angle ${short(smallestAngle, 2)}°, mean radius ratio ${short(meanRadiusRatio, 2)}`;
  const message = `with the given triangles, which are large for the thickness of the body, the elements were poor (${figures}), so all were replaced, as by \`surface: "remesh"\``;
  return packageDiagnostic("replaced-surface", message, keep, "information");
}
