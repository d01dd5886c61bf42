/** The better of two repairs, as far as the command line is concerned. */
import {
  type BestRepair,
  remeshedBest as betterRemeshed,
  type BestRepairOptions,
} from "../api/best-repair.js";
import { unlessFailed } from "../api/best-repair.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import type { MeshResult } from "../mesh/report.js";
import { InvalidInput } from "./messages.js";
import type { RemeshReport } from "./remeshing.js";

export { hasWelded } from "../api/best-repair.js";

/** As `remeshedBest` of the package; input that the exact repair refuses counts as a failure of the second way. */
export function remeshedBest<Prepared, Made extends { readonly remesh?: RemeshReport }>(
  prepared: Prepared,
  exact: (() => Promise<Prepared>) | undefined,
  remesh: (prepared: Prepared) => Promise<Made>,
  options: BestRepairOptions = {},
): Promise<BestRepair<Prepared, Made>> {
  const isRefusal = (failure: unknown) => failure instanceof InvalidInput;
  return betterRemeshed(prepared, exact, remesh, { ...options, isRefusal });
}

/** The way that was filled, and the result of filling it. */
export interface FilledRepair<Prepared, Made, Result> extends BestRepair<Prepared, Made> {
  readonly result: Result;
}

/**
 * Fills the better surface. If the engine refuses it, fails or stalls on it, fills that of the other way, and returns its
 * result if it is complete. Rejects if it is cancelled.
 */
export async function filledBest<Prepared, Made, Result extends Pick<MeshResult, "report">>(
  best: BestRepair<Prepared, Made>,
  fill: (made: Made) => Promise<Result>,
): Promise<FilledRepair<Prepared, Made, Result>> {
  const other = best.welded ?? best.exact;
  if (other === undefined) return { ...best, result: await fill(best.made) };
  const isExact = best.welded === undefined;
  const result = await unlessFailed(fill(best.made)).catch((failure: unknown) => {
    if (failure instanceof InvalidInput) return undefined;
    throw failure;
  });
  if (result?.report.status === "done" || result?.report.status === "cancelled") return { ...best, result };
  if (result === undefined) return { ...other, isExact, result: await fill(other.made) };
  // Whatever ends the second attempt, the first result is kept.
  const second = await fill(other.made).catch((failure: unknown) => {
    if (failure instanceof MesherError || failure instanceof InvalidInput) return undefined;
    throw failure;
  });
  return second?.report.status === "done" ? { ...other, isExact, result: second } : { ...best, result };
}

export const EXACT_REPAIR =
  "the triangles are better after an exact repair, which welds no nodes; it replaces the changes above";
