/** A repair that welds nodes before a remeshing, and an exact one, if the triangles are poor after the first. */
import { isBetter, isPoor, unlessFailed } from "../api/best-remesh.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { diagonalOf } from "../formats/near-points.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import { InvalidInput } from "./messages.js";
import type { RemeshReport } from "./remeshing.js";
import type { RepairedSurface } from "./repair.js";

/** Result of a remeshing, and the repaired surface of which it was made. */
export interface BestRepair<Prepared, Made> {
  readonly prepared: Prepared;
  readonly made: Made;
  /** Whether the exact repair was better. */
  readonly isExact: boolean;
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
  return isTaken ? { ...second, isExact: true } : first;
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
