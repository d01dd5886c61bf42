/** What `tetrafront mesh` does with the triangles of a surface before it fills the surface. */
import { hasRegionVolumes } from "../api/input-checks.js";
import type { Mesher } from "../api/mesher-interface.js";
import type { MeshOptions } from "../api/option-types.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import type { SurfaceInspection } from "../mesh/inspection.js";
import {
  refined,
  type RefinementCounts,
  type RemeshCommandOptions,
  remeshed,
  remeshOptions,
  type RemeshReport,
  type SurfaceTreatment,
} from "./remeshing.js";
import type { ControlOf } from "./run.js";
import { short } from "./tables.js";

export interface TreatedSurface {
  readonly surface: SurfaceFile;
  readonly refinement?: RefinementCounts;
  readonly remesh?: RemeshReport;
  /** Problems that prevent meshing. */
  readonly invalid?: readonly Diagnostic[];
  /** Warnings and notes. */
  readonly diagnostics?: readonly Diagnostic[];
}

export interface TreatmentOptions {
  /** As given by `--surface`, if at all. */
  readonly treatment: SurfaceTreatment | undefined;
  readonly remeshing: RemeshCommandOptions;
  /** Options of the mesh, including the background grid. */
  readonly options: MeshOptions;
  readonly controlOf: ControlOf;
}

/** Returns the surface as `--surface` states; by default, with smaller triangles where the sizes are far smaller. */
export async function treatedSurface(
  mesher: Mesher,
  given: SurfaceFile,
  wanted: TreatmentOptions,
): Promise<TreatedSurface> {
  const { treatment, remeshing, options, controlOf } = wanted;
  switch (treatment) {
    case "keep":
      return { surface: given };
    case "remesh":
      return remeshed(mesher, given, remeshOptions(remeshing, options), {
        ...controlOf("remesh"),
        partial: true,
      });
    case "refine": {
      const { found, refine } = await inspected(mesher, given, wanted);
      return found.isFillable ? refine() : { surface: given, invalid: found.diagnostics };
    }
    case undefined:
      return hasSizes(options) || hasRegionVolumes(given)
        ? withSmallerTriangles(mesher, given, wanted)
        : { surface: given };
  }
}

function hasSizes({ size, background, maxVolume }: MeshOptions): boolean {
  const sources = background?.sources ?? [];
  return (
    size !== undefined || maxVolume !== undefined || (background?.sizes.length ?? 0) > 0 || sources.length > 0
  );
}

/** Inspects before refining, so that diagnostics use the triangle indices of the given surface. */
async function inspected(
  mesher: Mesher,
  given: SurfaceFile,
  { options, controlOf }: TreatmentOptions,
): Promise<{ readonly found: SurfaceInspection; readonly refine: () => ReturnType<typeof refined> }> {
  const { innerShells } = options;
  const found = await mesher.inspectSurface(given, { innerShells }, controlOf());
  // The volume helps to estimate the number of elements only if the orientation of all triangles is known.
  const volume = found.flippedTriangles === 0 ? found.volume : undefined;
  return { found, refine: () => refined(mesher, given, { ...options, volume }, controlOf()) };
}

/** Longest edge / target length up to which triangles are kept by default; `coarse-surface` warns above it. */
const MAX_LENGTH_RATIO = 2;

/**
 * If triangles are far larger than the sizes, splits them; or replaces them, if many are needles, whose parts would be
 * needles too. The run reports what is wrong with a surface that cannot be filled.
 */
async function withSmallerTriangles(
  mesher: Mesher,
  given: SurfaceFile,
  treating: TreatmentOptions,
): Promise<TreatedSurface> {
  const { found, refine } = await inspected(mesher, given, treating);
  if (!found.isFillable) return { surface: given };
  const split = await refine();
  const { lengthRatio } = split.refinement;
  if (lengthRatio <= MAX_LENGTH_RATIO) return { surface: given };
  const hasNeedles = found.diagnostics.some(({ code }) => code === "needle-surface");
  if (!hasNeedles) return { ...split, diagnostics: [divided(lengthRatio, "split", "refine")] };
  const { options, controlOf } = treating;
  const control = { ...controlOf("remesh"), partial: true };
  const made = await remeshed(mesher, given, remeshOptions({}, options), control);
  return { ...made, diagnostics: [divided(lengthRatio, "replaced", "remesh"), ...made.diagnostics] };
}

function divided(lengthRatio: number, what: string, treatment: SurfaceTreatment): Diagnostic {
  const ratio = short(lengthRatio, 2);
  const message = `triangles had edges up to ${ratio} times the target length, so they were ${what}, as by --surface ${treatment}`;
  return packageDiagnostic("divided-surface", message, "Use --surface keep to keep them.", "information");
}
