/** Fills polygons by the engine's front of a patch, in the caller's thread, and returns the record of its steps. */
import { compile } from "#compile";
import { notLoadedError } from "../diagnostics/mesher-error.js";
import { textOf } from "../engine/lazy-module.js";
import { loadPlane } from "../engine/plane-loader.js";
import type { FillPlaneOptions, FillPlaneResult, PlaneLoop, PlaneSizes } from "./plane-types.js";

/** The loaded front of the plane. */
export interface PlaneFront {
  /**
   * Fills a polygon at once, in the caller's thread: `fillPlane` without waiting. Throws a `MesherError` if an option is
   * invalid or memory runs out.
   */
  fill(loops: readonly PlaneLoop[], sizes: PlaneSizes, options?: FillPlaneOptions): FillPlaneResult;
}

let loading: Promise<PlaneFront> | undefined;

/**
 * Loads the front of the plane, a file of its own, once per page or thread, for figures that are filled again while they are dragged.
 * Rejects with a `MesherError` of code `engine-not-loaded` if it cannot be loaded; the next call tries again.
 *
 *     const front = await loadPlaneFront();
 *     onDrag = (corners) => draw(front.fill([corners], 0.2));
 */
export function loadPlaneFront(): Promise<PlaneFront> {
  // What fills polygons is loaded with the module: other users of this entry do without.
  loading ??= Promise.all([loadPlane(compile), import("./plane-front.js")]).then(
    ([engine, { filledPlane }]) => ({
      fill: (loops, sizes, options = {}) => filledPlane(engine, loops, sizes, options),
    }),
    (failure: unknown) => {
      loading = undefined;
      throw notLoadedError("engine", textOf(failure), "Check the connection, then try again.");
    },
  );
  return loading;
}

/**
 * Fills a polygon with triangles by the engine's front of a patch, and returns the record of its steps. Deterministic: the same bits
 * in every browser and in Node. By default, the triangles are those of a drawn planar patch with the same lines, sizes and axes.
 * Works in the caller's thread, about a millisecond per 100 triangles; the first call loads the front.
 *
 *     const filled = await fillPlane([[[0, 0], [4, 0], [4, 3], [0, 3]]], 0.5);
 *     if (filled.success) console.log(filled.trace.stepAt(filled.front.firstStep + 1));
 *     else console.error(filled.message);
 *
 * @param loops The outer loop, then the holes; each in either orientation.
 * @param sizes One size, or sizes that differ by position, and also by direction.
 */
export async function fillPlane(
  loops: readonly PlaneLoop[],
  sizes: PlaneSizes,
  options: FillPlaneOptions = {},
): Promise<FillPlaneResult> {
  return (await loadPlaneFront()).fill(loops, sizes, options);
}
