/** A repair that welds nodes before a remeshing, and an exact one, if the triangles are poor after the first. */
import { MesherError } from "../diagnostics/mesher-error.js";
import { diagonalOf } from "../formats/near-points.js";
import type { SurfaceRemesh } from "../mesh/inspection.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import type { MeshResult } from "../mesh/report.js";

/** Figures of a remeshing by which two are compared. */
export type RemeshShapes = Pick<SurfaceRemesh, "isPartial" | "smallestAngle" | "meanRadiusRatio">;

/**
 * Smallest angle, in degrees, below which triangles are so poor that another way is worth its time. Above, the dihedral angles of
 * the tetrahedra do not depend on the way: of 60 random unions of bodies, none was below 20°.
 */
const POOR_ANGLE = 5;

/** Difference of the mean radius ratio that does not matter. */
const RATIO_NOISE = 0.005;

/** Result of a remeshing, and the repaired surface of which it was made. */
export interface BestRepair<Prepared, Made> {
  readonly prepared: Prepared;
  readonly made: Made;
  /** Whether the exact repair was better. */
  readonly isExact: boolean;
  /** Result after the repair that welds nodes, if the exact one was better. */
  readonly welded?: { readonly prepared: Prepared; readonly made: Made } | undefined;
  /** Result after the exact repair, if it is complete and not better. */
  readonly exact?: { readonly prepared: Prepared; readonly made: Made } | undefined;
}

/** Largest deviation of an exact repair / diagonal: it welds within at most a millionth of the largest coordinate. */
const EXACT = 2e-6;

/**
 * Returns whether the repair of a surface welded nodes, so that an exact one gives another surface. `repairDeviation`: that of
 * the repair with `weldIntersections`.
 */
export function hasWelded(
  { points }: Pick<SurfaceInput, "points">,
  { repairDeviation = 0 }: { readonly repairDeviation?: number | undefined },
): boolean {
  return repairDeviation > EXACT * diagonalOf(points);
}

/** How `remeshedBest` ends when its second way does not. */
export interface BestRepairOptions {
  /** Whether the first result is returned as a partial one if the second way is stopped. Default false. */
  readonly partial?: boolean;
}

/**
 * Remeshes a repaired surface. If its triangles are poor, does the same after the exact repair, if there is one, and
 * returns the better result; the first one if the second way fails. If the second way is stopped, returns the first
 * result as a partial one if `partial`; rejects otherwise.
 *
 *     const repair = (weldIntersections: number) => mesher.repairSurface(surface, { weldIntersections });
 *     const welded = await repair(0.01);
 *     const best = await remeshedBest(welded, () => repair(0), async ({ surface: one }) => ({
 *       remesh: await mesher.remeshSurface(one),
 *     }));
 */
export async function remeshedBest<Prepared, Made extends { readonly remesh?: RemeshShapes }>(
  prepared: Prepared,
  exact: (() => Promise<Prepared>) | undefined,
  remesh: (prepared: Prepared) => Promise<Made>,
  { partial = false }: BestRepairOptions = {},
): Promise<BestRepair<Prepared, Made>> {
  const made = await remesh(prepared);
  const first = { prepared, made, isExact: false };
  if (exact === undefined || made.remesh === undefined || !isPoor(made.remesh)) return first;
  const stopped = { ...first, made: { ...made, remesh: { ...made.remesh, isPartial: true } } };
  const second = await unlessFailed(other(exact, remesh)).catch((failure: unknown) => {
    if (partial && failure instanceof MesherError && failure.code === "cancelled") return stopped;
    throw failure;
  });
  if (second?.made.remesh?.isPartial === true) return stopped;
  const isTaken = second?.made.remesh !== undefined && isBetter(second.made.remesh, made.remesh);
  return isTaken ? { ...second, isExact: true, welded: { prepared, made } } : { ...first, exact: second };
}

async function other<Prepared, Made>(
  exact: () => Promise<Prepared>,
  remesh: (prepared: Prepared) => Promise<Made>,
): Promise<{ readonly prepared: Prepared; readonly made: Made }> {
  const prepared = await exact();
  return { prepared, made: await remesh(prepared) };
}

/** Returns whether a finished remeshing has triangles so poor that another way is worth its time. */
function isPoor({ isPartial, smallestAngle }: RemeshShapes): boolean {
  return !isPartial && smallestAngle < POOR_ANGLE;
}

/** Returns whether a remeshing has a larger smallest angle than another, without poorer triangles on average. */
function isBetter(one: RemeshShapes, other: RemeshShapes): boolean {
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

/** The way that was filled, and the result of filling it. */
export interface FilledRepair<Prepared, Made, Result> extends BestRepair<Prepared, Made> {
  readonly result: Result;
}

/** Smallest dihedral angle, in degrees, from which on a mesh is kept although triangles of its surface are poor. */
const FIT_ANGLE = 15;

/** The part of a result by which two meshes are compared. */
type ComparedResult = Pick<MeshResult, "report">;

/**
 * Remeshes and fills a repaired surface. Poor triangles need not make poor elements: only if these are unfit, or if the engine
 * refuses the surface, fails or stalls, does the same after the exact repair, if there is one, and returns the better mesh.
 */
export async function meshedBest<
  Prepared,
  Made extends { readonly remesh?: RemeshShapes },
  Result extends ComparedResult,
>(
  prepared: Prepared,
  exact: (() => Promise<Prepared>) | undefined,
  remesh: (prepared: Prepared) => Promise<Made>,
  fill: (made: Made) => Promise<Result>,
): Promise<FilledRepair<Prepared, Made, Result>> {
  const made = await remesh(prepared);
  const first = { prepared, made, isExact: false };
  const filling = fill(made);
  if (exact === undefined || made.remesh === undefined || !isPoor(made.remesh))
    return { ...first, result: await filling };
  const result = await unlessFailed(filling);
  if (result !== undefined && (isFit(result) || result.report.status === "cancelled"))
    return { ...first, result };
  const best = await remeshedBest(prepared, exact, (one) =>
    one === prepared ? Promise.resolve(made) : remesh(one),
  );
  const filled = await filledBest(best, (one) => (one === made ? filling : fill(one)));
  const isWorse = result !== undefined && smallestAngleOf(filled.result) < smallestAngleOf(result);
  return isWorse && filled.result.report.status === "done" ? { ...first, result } : filled;
}

/** Returns the smallest dihedral angle of a mesh; less than any if there is none. */
function smallestAngleOf({ report }: ComparedResult): number {
  return report.status === "done" ? report.dihedral.min : -1;
}

const isFit = (result: ComparedResult): boolean => smallestAngleOf(result) >= FIT_ANGLE;

/**
 * Fills the better surface. If the engine refuses it, fails or stalls on it, fills that of the other way, and returns its
 * result if it is complete. Rejects if it is cancelled.
 */
export async function filledBest<Prepared, Made, Result extends ComparedResult>(
  best: BestRepair<Prepared, Made>,
  fill: (made: Made) => Promise<Result>,
): Promise<FilledRepair<Prepared, Made, Result>> {
  const other = best.welded ?? best.exact;
  if (other === undefined) return { ...best, result: await fill(best.made) };
  const isExact = best.welded === undefined;
  const result = await unlessFailed(fill(best.made));
  if (result?.report.status === "done" || result?.report.status === "cancelled") return { ...best, result };
  if (result === undefined) return { ...other, isExact, result: await fill(other.made) };
  // Whatever ends the second attempt, the first result is kept.
  const second = await fill(other.made).catch((failure: unknown) => {
    if (failure instanceof MesherError) return undefined;
    throw failure;
  });
  return second?.report.status === "done" ? { ...other, isExact, result: second } : { ...best, result };
}
