/** Fills a surface with a number of elements: remeshes or refines it with one factor on all sizes. */
import type { RunControl } from "../engine/control.js";
import type { MeshResult } from "../mesh/report.js";
import type { FinerPart } from "./element-count.js";
import { controlOfPart, elementsReached } from "./element-target.js";
import type { Mesher } from "./mesher-interface.js";
import type { MeshOptions, SurfaceMeshOptions } from "./option-types.js";
import {
  ballOf,
  longestEdge,
  scaledKeptOptions,
  scaledMeshOptions,
  scaledRemeshOptions,
  type SizeBall,
  withBall,
} from "./scaled-sizes.js";
import { meshPart, remeshSettings } from "./surface-mesh-options.js";
import type { ControlOf } from "./surface-treatment.js";
import type { Mesh } from "../mesh/mesh.js";

/** What a run with a factor is given. */
export interface ScaledFilling {
  readonly options: SurfaceMeshOptions;
  /** Factor on the automatic sizes of a remeshing. */
  readonly sizeFactor: number;
  readonly controlOf: ControlOf;
}

/** A surface that is ready, and what becomes of its triangles. */
export interface CountedSurface {
  readonly surface: Mesh;
  readonly isRemeshed: boolean;
}

/** Part of a run that is spent on the treatment of the surface: an estimate for the progress. */
const TREATMENT_SHARE = 0.5;

/** Calls `fill` until the mesh has the number of elements. Rejects as `fill` does. */
export async function filledToElements<Made extends MeshResult>(
  mesher: Mesher,
  { surface, isRemeshed }: CountedSurface,
  { elements, options, controlOf }: Omit<ScaledFilling, "sizeFactor"> & { readonly elements: number },
  fill: (filling: ScaledFilling) => Promise<Made>,
): Promise<Made> {
  const scaled = isRemeshed ? scaledMeshOptions : refiningOptions(surface, options);
  const hasGrid = (options.background?.sizes.length ?? 0) > 0;
  const control = controlOf();
  const run = async (sizeFactor: number, ofRun: RunControl, finer?: FinerPart): Promise<Made> => {
    const ball = finer && (await finerBall(mesher, surface, options, finer));
    const mesh = scaled(meshPart(options), sizeFactor);
    const ofStep = (step?: string): RunControl =>
      step === "remesh" ? controlOfPart(ofRun, 0, TREATMENT_SHARE) : controlOfPart(ofRun, TREATMENT_SHARE, 1);
    return fill({
      options: { ...options, ...mesh, background: withBall(mesh.background, ball) },
      sizeFactor,
      controlOf: (step) => ({ ...controlOf(step), ...ofStep(step) }),
    });
  };
  const expected = isRemeshed && !hasGrid ? await expectedElements(mesher, surface, options, control) : null;
  const hasFinerParts = isRemeshed && !hasGrid;
  return elementsReached({ elements, expected, hasFinerParts, run }, control);
}

/** Returns the options with which a surface is refined and filled, by the factor on its longest edge. */
function refiningOptions(
  surface: Mesh,
  { background }: MeshOptions,
): (options: MeshOptions, factor: number) => MeshOptions {
  const longest = longestEdge(surface);
  const hasGrid = (background?.sizes.length ?? 0) > 0;
  return (options, factor) => ({
    ...scaledKeptOptions(options, factor, longest),
    ...(!hasGrid && { size: longest * Math.min(1, factor) }),
  });
}

/** Returns a ball with the largest size that a remeshing with the finer factor would have. */
async function finerBall(
  mesher: Mesher,
  surface: Mesh,
  options: SurfaceMeshOptions,
  { factor, share }: FinerPart,
): Promise<SizeBall> {
  const { size } = await mesher.proposeSurfaceSizes(surface, automaticSizes(options, factor));
  return ballOf(surface.points, size, share);
}

/** Returns the number of elements that a remeshing with automatic sizes is expected to lead to. */
async function expectedElements(
  mesher: Mesher,
  surface: Mesh,
  options: SurfaceMeshOptions,
  { signal }: RunControl,
): Promise<number> {
  const { tetrahedra } = await mesher.proposeSurfaceSizes(surface, automaticSizes(options, 1), { signal });
  return tetrahedra;
}

function automaticSizes(options: SurfaceMeshOptions, factor: number) {
  const { dropDetails: _, ...settings } = remeshSettings(options);
  const { growth, maxVolume, innerShells } = options;
  const { background: __, ...sizes } = scaledRemeshOptions(
    { ...settings, growth, maxVolume, innerShells },
    factor,
  );
  return sizes;
}
