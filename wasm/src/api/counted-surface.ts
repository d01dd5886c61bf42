/** Fills a surface with a number of elements: remeshes or refines it with one factor on all sizes. */
import type { RunControl } from "../engine/control.js";
import type { Mesh, SurfaceInput } from "../mesh/mesh.js";
import type { MeshResult } from "../mesh/report.js";
import type { FinerPart } from "./element-count.js";
import { elementsReached } from "./element-target.js";
import type { Mesher, SurfaceSizeProposal } from "./mesher-interface.js";
import type { MeshOptions, RemeshOptions, SurfaceMeshOptions } from "./option-types.js";
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
import { WholeProgress } from "./whole-progress.js";

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
  /** Its parts; each is prepared by itself. */
  readonly parts: readonly Mesh[];
  readonly isRemeshed: boolean;
}

/** Calls `fill` until the mesh has the number of elements. Rejects as `fill` does. */
export async function filledToElements<Made extends MeshResult>(
  mesher: Mesher,
  { surface, parts, isRemeshed }: CountedSurface,
  { elements, options, controlOf }: Omit<ScaledFilling, "sizeFactor"> & { readonly elements: number },
  fill: (filling: ScaledFilling) => Promise<Made>,
): Promise<Made> {
  const scaled = isRemeshed ? scaledMeshOptions : refiningOptions(surface, options);
  const hasGrid = (options.background?.sizes.length ?? 0) > 0;
  const control = controlOf();
  const { growth, maxVolume, innerShells } = options;
  const sizing = { ...remeshSettings(options), growth, maxVolume, innerShells };
  const sized = parts.map((part) => ({ surface: part, options: sizing }));
  const finerBall = async ({ factor, share }: FinerPart): Promise<SizeBall> =>
    ballOf(surface.points, await largestAutomaticSize(mesher, sized, factor), share);
  const run = async (sizeFactor: number, ofRun: RunControl, finer?: FinerPart): Promise<Made> => {
    const ball = finer && (await finerBall(finer));
    const mesh = scaled(meshPart(options), sizeFactor);
    return fill({
      options: { ...options, ...mesh, background: withBall(mesh.background, ball) },
      sizeFactor,
      controlOf: new WholeProgress(ofRun).controlOf,
    });
  };
  const expected = isRemeshed && !hasGrid ? await expectedElements(mesher, sized, control) : null;
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

/** A surface that is remeshed, and the options that decide its automatic sizes. */
export interface SizedSurface {
  readonly surface: SurfaceInput;
  readonly options: RemeshOptions;
}

type SizeMesher = Pick<Mesher, "proposeSurfaceSizes">;

/** Returns the largest size that remeshings of surfaces with a factor on automatic sizes would have. */
export async function largestAutomaticSize(
  mesher: SizeMesher,
  surfaces: readonly SizedSurface[],
  factor: number,
): Promise<number> {
  const found = await proposals(mesher, surfaces, factor);
  return Math.max(...found.map(({ size }) => size));
}

/** Returns the number of elements that remeshings of surfaces with automatic sizes are expected to lead to. */
export async function expectedElements(
  mesher: SizeMesher,
  surfaces: readonly SizedSurface[],
  { signal }: RunControl,
): Promise<number> {
  const found = await proposals(mesher, surfaces, 1, { signal });
  return found.reduce((sum, { tetrahedra }) => sum + tetrahedra, 0);
}

async function proposals(
  mesher: SizeMesher,
  surfaces: readonly SizedSurface[],
  factor: number,
  control: RunControl = {},
): Promise<SurfaceSizeProposal[]> {
  const found: SurfaceSizeProposal[] = [];
  for (const { surface, options } of surfaces) {
    const { dropDetails: _, ...settings } = options;
    const { background: __, ...sizes } = scaledRemeshOptions(settings, factor);
    found.push(await mesher.proposeSurfaceSizes(surface, sizes, control));
  }
  return found;
}

export { elementsReached } from "./element-target.js";
