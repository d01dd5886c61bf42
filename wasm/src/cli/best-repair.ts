/** A repair that welds nodes before a remeshing, and an exact one, if the triangles are poor after the first. */
import { isBetter, isPoor, unlessFailed } from "../api/best-remesh.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { diagonalOf } from "../formats/near-points.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import type { MeshResult } from "../mesh/report.js";
import { InvalidInput } from "./messages.js";
import type { RemeshReport } from "./remeshing.js";
import type { RepairedSurface } from "./repair.js";

/** Result of a remeshing, and the repaired surface of which it was made. */
export interface BestRepair<Prepared, Made> {
  readonly prepared: Prepared;
  readonly made: Made;
  /** Whether the exact repair was better. */
  readonly isExact: boolean;
  /** Result after the repair that welds nodes, if the exact one was better. */
  readonly welded?: { readonly prepared: Prepared; readonly made: Made } | undefined;
}

/** Largest deviation of an exact repair / diagonal: it welds within far less than the step height. */
const EXACT = 1e-5;

/** Returns whether the repair of a surface welded nodes, so that an exact one gives another surface. */
export function hasWelded(
  { points }: Pick<SurfaceFile, "points">,
  { repairDeviation = 0 }: Pick<RepairedSurface, "repairDeviation">,
): boolean {
  return repairDeviation > EXACT * diagonalOf(points);
}

/**
 * Remeshes a repaired surface. If its triangles are poor, does the same after the exact repair, if there is one, and
 * returns the better result; the first one if the second way fails. If the second way is stopped, returns the first
 * result as a partial one if `partial`; rejects otherwise.
 */
export async function remeshedBest<Prepared, Made extends { readonly remesh?: RemeshReport }>(
  prepared: Prepared,
  exact: (() => Promise<Prepared>) | undefined,
  remesh: (prepared: Prepared) => Promise<Made>,
  { partial = false }: { readonly partial?: boolean } = {},
): Promise<BestRepair<Prepared, Made>> {
  const made = await remesh(prepared);
  const first = { prepared, made, isExact: false };
  if (exact === undefined || made.remesh === undefined || !isPoor(made.remesh)) return first;
  const stopped = { ...first, made: { ...made, remesh: { ...made.remesh, isPartial: true } } };
  const second = await unlessInvalid(other(exact, remesh)).catch((failure: unknown) => {
    if (partial && failure instanceof MesherError && failure.code === "cancelled") return stopped;
    throw failure;
  });
  if (second?.made.remesh?.isPartial === true) return stopped;
  const isTaken = second?.made.remesh !== undefined && isBetter(second.made.remesh, made.remesh);
  return isTaken ? { ...second, isExact: true, welded: { prepared, made } } : first;
}

/** The way that was filled, and the result of filling it. */
export interface FilledRepair<Prepared, Made, Result> extends BestRepair<Prepared, Made> {
  readonly result: Result;
}

/**
 * Fills the better surface. If the engine fails or stalls on that of the exact repair, fills that of the welded one, and
 * returns its result if it is complete. Rejects if it is cancelled.
 */
export async function filledBest<Prepared, Made, Result extends Pick<MeshResult, "report">>(
  best: BestRepair<Prepared, Made>,
  fill: (made: Made) => Promise<Result>,
): Promise<FilledRepair<Prepared, Made, Result>> {
  const { welded } = best;
  if (welded === undefined) return { ...best, result: await fill(best.made) };
  const result = await unlessFailed(fill(best.made));
  if (result?.report.status === "done" || result?.report.status === "cancelled") return { ...best, result };
  const second = await fill(welded.made);
  const isKept = result !== undefined && second.report.status !== "done";
  return isKept ? { ...best, result } : { ...welded, isExact: false, result: second };
}

async function other<Prepared, Made>(
  exact: () => Promise<Prepared>,
  remesh: (prepared: Prepared) => Promise<Made>,
): Promise<{ readonly prepared: Prepared; readonly made: Made }> {
  const prepared = await exact();
  return { prepared, made: await remesh(prepared) };
}

async function unlessInvalid<Result>(made: Promise<Result>): Promise<Result | undefined> {
  try {
    return await unlessFailed(made);
  } catch (failure) {
    if (failure instanceof InvalidInput) return undefined;
    throw failure;
  }
}

export const EXACT_REPAIR =
  "the triangles are better after an exact repair, which welds no nodes; it replaces the changes above";
