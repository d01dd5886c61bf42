/** The solid of a list of features as a surface: its faces are patches, named by origin. */
import { inSteps } from "../calls/yielder.js";
import { cadShapesOf } from "../cad/cad-shapes.js";
import { DEFLECTION } from "../cad/deflection.js";
import { type EdgeLine, withShape } from "../cad/features/evaluate.js";
import type { Feature, FeatureFailure } from "../cad/features/feature.js";
import type { FeatureKernel } from "../cad/features/session.js";
import { triangulatedShape } from "../cad/kernel.js";
import type { CadKernel } from "../cad/kernel-classes.js";
import type { Mesh } from "../mesh/mesh.js";
import { joinedSurface } from "./shape-surface.js";

export interface FeatureSolid {
  /** With its true faces; undefined if the features give no solid. */
  readonly surface: Mesh | undefined;
  /** Per patch of the surface: the name of its face by origin; undefined for a face that two solids share. */
  readonly origins: readonly (string | undefined)[];
  readonly edges: readonly EdgeLine[];
  /** The features that were left out, and why. */
  readonly failures: readonly FeatureFailure[];
  /** Whether the kernel must not be used again. */
  readonly isKernelSpent: boolean;
}

/** Evaluates features in the kernel of the caller. Its exceptions that are no feature's are thrown. */
export async function featureSolid(
  kernel: FeatureKernel,
  features: readonly Feature[],
): Promise<FeatureSolid> {
  const { result, faces, edges, failures, isKernelSpent } = withShape(kernel, features, (shape) =>
    triangulatedShape(kernel as unknown as CadKernel, shape as never, DEFLECTION),
  );
  if (result === undefined) return { surface: undefined, origins: [], edges, failures, isKernelSpent };
  const shapes = cadShapesOf({ text: result }, undefined);
  const { mesh } = await inSteps(joinedSurface(shapes));
  const trueFaces = shapes.flatMap(({ trueFaces: own }) => own ?? []).map(({ missing: _, ...own }) => own);
  // The tag of a patch is the number of its face; faces that are shared come after them.
  const origins = mesh.patches.map(({ tag }) => faces[tag - 1]);
  return { surface: { ...mesh, trueFaces }, origins, edges, failures, isKernelSpent };
}
