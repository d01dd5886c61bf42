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
}

/** A way to make something. Resolves with undefined if it is not worth its time, given the best of the ways before. */
export type Attempt<Made> = (best: Made | undefined) => Promise<Made | undefined>;

/**
 * Makes something in one way after the other, and returns the best. A way that fails is left out; rejects with the first failure
 * if all fail, and at once if one is cancelled or the mesher is disposed of.
 */
export async function bestOf<Made>(
  attempts: readonly Attempt<Made>[],
  isBetter: (made: Made, best: Made) => boolean,
): Promise<Made> {
  let best: Made | undefined;
  let first: unknown;
  for (const attempt of attempts) {
    try {
      const made = await attempt(best);
      if (made !== undefined && (best === undefined || isBetter(made, best))) best = made;
    } catch (failure) {
      if (!isFailure(failure)) throw failure;
      first ??= failure;
    }
  }
  if (best === undefined) throw first;
  return best;
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
export function remeshedBest<Prepared, Made extends Remeshed>(
  prepared: Prepared,
  exact: (() => Promise<Prepared>) | undefined,
  remesh: (prepared: Prepared) => Promise<Made>,
  { partial = false }: BestRepairOptions = {},
): Promise<BestRepair<Prepared, Made>> {
  return bestOf<BestRepair<Prepared, Made>>(
    [
      async () => ({ prepared, made: await remesh(prepared), isExact: false }),
      async (first) => {
        if (first === undefined || exact === undefined || !isPoor(first.made)) return undefined;
        const second = await afterExact(exact, remesh).catch((failure: unknown) => {
          if (partial && failure instanceof MesherError && failure.code === "cancelled")
            return stopped(first);
          throw failure;
        });
        return isPartial(second.made) ? stopped(first) : second;
      },
    ],
    (second, first) => isPartial(second.made) || areBetter(second.made, first.made),
  );
}

interface Remeshed {
  readonly remesh?: RemeshShapes;
}

async function afterExact<Prepared, Made>(
  exact: () => Promise<Prepared>,
  remesh: (prepared: Prepared) => Promise<Made>,
): Promise<BestRepair<Prepared, Made>> {
  const prepared = await exact();
  return { prepared, made: await remesh(prepared), isExact: true };
}

const isPartial = ({ remesh }: Remeshed): boolean => remesh?.isPartial === true;

/** Returns the first result as a partial one, since the second way was stopped. */
function stopped<Prepared, Made extends Remeshed>(first: BestRepair<Prepared, Made>): typeof first {
  const { remesh } = first.made;
  return { ...first, made: { ...first.made, ...(remesh && { remesh: { ...remesh, isPartial: true } }) } };
}

/** Returns whether a finished remeshing has triangles so poor that another way is worth its time. */
const isPoor = ({ remesh }: Remeshed): boolean =>
  remesh !== undefined && !remesh.isPartial && remesh.smallestAngle < POOR_ANGLE;

/** Returns whether a remeshing has a larger smallest angle than another, without poorer triangles on average. */
function areBetter({ remesh: one }: Remeshed, { remesh: other }: Remeshed): boolean {
  if (one === undefined || other === undefined || one.isPartial) return false;
  const isWorseOnAverage = one.meanRadiusRatio <= other.meanRadiusRatio - RATIO_NOISE;
  return one.smallestAngle > other.smallestAngle && !isWorseOnAverage;
}

/** Returns whether a call has failed: it was not cancelled, and the mesher not disposed of. */
const isFailure = (failure: unknown): boolean =>
  failure instanceof MesherError && failure.code !== "cancelled" && failure.code !== "disposed";

/** Resolves with undefined if a call fails. Rejects if it is cancelled, or the mesher is disposed of. */
export function unlessFailed<Result>(made: Promise<Result>): Promise<Result | undefined> {
  return made.catch((failure: unknown) => {
    if (isFailure(failure)) return undefined;
    throw failure;
  });
}

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
export async function meshedBest<Prepared, Made extends Remeshed, Result extends ComparedResult>(
  prepared: Prepared,
  exact: (() => Promise<Prepared>) | undefined,
  remesh: (prepared: Prepared) => Promise<Made>,
  fill: (made: Made) => Promise<Result>,
): Promise<FilledRepair<Prepared, Made, Result>> {
  const welded = { prepared, made: await remesh(prepared), isExact: false };
  const filled = async (way: BestRepair<Prepared, Made>) => ({ ...way, result: await fill(way.made) });
  return bestOf<FilledRepair<Prepared, Made, Result>>(
    [
      () => filled(welded),
      async (first) => {
        if (exact === undefined || !isPoor(welded.made) || (first && isEnough(first.result)))
          return undefined;
        const second = await afterExact(exact, remesh);
        if (isPartial(second.made)) return filled(stopped(welded));
        const isHopeless = first?.result.report.status === "done" && !areBetter(second.made, welded.made);
        return isHopeless ? undefined : filled(second);
      },
    ],
    (second, first) => {
      const { status } = second.result.report;
      if (status === "done") return smallestAngleOf(second.result) >= smallestAngleOf(first.result);
      const isFirstDone = first.result.report.status === "done";
      return status === "cancelled" || (!isFirstDone && areBetter(second.made, first.made));
    },
  );
}

/** Returns the smallest dihedral angle of a mesh; less than any if there is none. */
function smallestAngleOf({ report }: ComparedResult): number {
  return report.status === "done" ? report.dihedral.min : -1;
}

const isEnough = (result: ComparedResult): boolean =>
  smallestAngleOf(result) >= FIT_ANGLE || result.report.status === "cancelled";
