/** A remeshing with automatic options merges details that would leave poor triangles. */
import { MesherError } from "../diagnostics/mesher-error.js";
import type { PartialControl } from "../engine/control.js";
import { diagonalOf } from "../formats/near-points.js";
import type { SurfaceRemesh } from "../mesh/inspection.js";
import type { RemeshOptions } from "./option-types.js";

/** Smallest angle, in degrees, below which details are merged, and up to which length, relative to the diagonal. */
const POOR_ANGLE = 10;
const DROPPED = 1 / 2500;

/** Differences of the mean radius ratio that do not matter. */
const RATIO_NOISE = 0.005;

/** Estimated share of the work that the first remeshing is. */
const FIRST_SHARE = 0.55;

/** Options by which a remeshing is not automatic. */
const CHOSEN = [
  "size",
  "minSize",
  "maxSize",
  "tolerance",
  "featureAngle",
  "anglePerEdge",
  "layers",
  "dropDetails",
  "maxVolume",
  "background",
] as const satisfies readonly (keyof RemeshOptions)[];

/** Returns whether no option is given that a remeshing would choose by itself. */
export function isAutomaticRemesh(options: RemeshOptions): boolean {
  return CHOSEN.every((name) => options[name] === undefined);
}

/**
 * Remeshes a surface with automatic options. If its triangles are poor because of narrow details, merges these, unless
 * that gives a smaller smallest angle. `remesh`: one remeshing with such options. If the second one is stopped, the result
 * is that of the first, but `isPartial`; if it fails, the result is that of the first. Rejects if it is cancelled.
 */
export async function remeshBest(
  remesh: (options: RemeshOptions, control: PartialControl) => Promise<SurfaceRemesh>,
  points: Float64Array,
  options: RemeshOptions,
  control: PartialControl,
): Promise<SurfaceRemesh> {
  const all = await remesh(options, partOf(control, 0, FIRST_SHARE));
  if (!isPoor(all)) return all;
  const dropDetails = DROPPED * diagonalOf(points);
  // The distances of both steps add up. Nobody has asked for more than the tolerance.
  const tolerance = all.tolerance - dropDetails;
  if (tolerance <= 0) return all;
  const second = remesh({ ...options, dropDetails, tolerance }, partOf(control, FIRST_SHARE, 1));
  const merged = await unlessFailed(second);
  if (merged === undefined) return all;
  if (merged.isPartial) return { ...all, isPartial: true };
  if (merged.deviation > all.tolerance || !isBetter(merged, all)) return all;
  const diagnostics = merged.diagnostics.filter(({ code }) => code !== "deviation-above-tolerance");
  return { ...merged, tolerance: all.tolerance, diagnostics };
}

type Shapes = Pick<SurfaceRemesh, "isPartial" | "smallestAngle" | "meanRadiusRatio">;

/** Returns whether a finished remeshing has triangles so poor that another way is worth its time. */
export function isPoor({ isPartial, smallestAngle }: Shapes): boolean {
  return !isPartial && smallestAngle < POOR_ANGLE;
}

/** Returns whether a remeshing has a larger smallest angle than another, without poorer triangles on average. */
export function isBetter(one: Shapes, other: Shapes): boolean {
  const isWorseOnAverage = one.meanRadiusRatio <= other.meanRadiusRatio - RATIO_NOISE;
  return !one.isPartial && one.smallestAngle > other.smallestAngle && !isWorseOnAverage;
}

/** Resolves with undefined if a call fails. Rejects if it is cancelled, or the mesher is disposed of. */
export async function unlessFailed<Result>(made: Promise<Result>): Promise<Result | undefined> {
  try {
    return await made;
  } catch (failure) {
    const isFailed = failure instanceof MesherError && !ended.includes(failure.code);
    if (isFailed) return undefined;
    throw failure;
  }
}

/** Codes of errors that the caller has caused. */
const ended: readonly MesherError["code"][] = ["cancelled", "disposed"];

/** Returns a control whose progress is a part of the whole. */
function partOf(control: PartialControl, from: number, to: number): PartialControl {
  const { onProgress } = control;
  if (onProgress === undefined) return control;
  return {
    ...control,
    onProgress: (progress) => onProgress({ ...progress, fraction: from + (to - from) * progress.fraction }),
  };
}
