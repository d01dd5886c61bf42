import type { Mesher } from "tetrafront";
import { hasWelded, remeshedBest, type RemeshShapes } from "tetrafront/internal";
import type { ProjectBody } from "tetrafront/project";
import {
  placedLength,
  sharedVolume,
  weldBeforeRemeshing,
  withTreatmentAfter,
  type RepairProposal,
  type RepairWishes,
} from "../document/body-repair";
import type { LoadedSurface } from "../workers/surface-files";

/** Finds out what a repair would change. `isExact`: whether no nodes of intersecting triangles are welded. */
export async function proposedRepair(
  mesher: Mesher,
  body: ProjectBody,
  { surface, drawn }: LoadedSurface,
  wishes: RepairWishes,
  { isExact = false, signal }: { readonly isExact?: boolean; readonly signal: AbortSignal },
): Promise<RepairProposal> {
  const patches = body.patches.map(({ id, name = "" }) => ({ name, tag: id }));
  const weldIntersections = isExact ? 0 : weldBeforeRemeshing(body, drawn);
  const repair = await mesher.repairSurface(
    { ...surface, patches },
    { ...wishes, weldIntersections },
    { signal },
  );
  const treated = withTreatmentAfter(repair.changes, body);
  if (treated !== body)
    return proposedRepair(mesher, treated, { surface, drawn }, wishes, { isExact, signal });
  const repaired = repair.mesh;
  const after = await mesher.inspectSurface(repaired, {}, { signal });
  const { points, triangles, trianglePatch } = repaired;
  const isCut = repair.changes.some(({ kind }) => kind === "resolved-intersection");
  const isUnited = isCut && after.isFillable;
  return {
    wishes,
    changes: repair.changes,
    deviation: repair.deviation,
    unresolved: repair.diagnostics,
    shared: isUnited ? sharedVolume(surface, after.volume) : 0,
    isExact,
    hasWelded: !isExact && hasWelded(repaired, { repairDeviation: repair.deviation }),
    comparison: null,
    after,
    surface: { points, triangles, trianglePatch },
    hasFilled: repaired.patches.length > patches.length,
  };
}

/** Returns whether an exact repair gives another surface, whose remeshing may be better. */
export function canCompare({ surface = "remesh" }: ProjectBody, proposal: RepairProposal): boolean {
  const { after, comparison } = proposal;
  return surface === "remesh" && after.isFillable && comparison === null && proposal.hasWelded;
}

/**
 * Remeshes the surface of a repair that welds nodes and, if its triangles are poor, that of the exact repair; returns the better
 * proposal, with both smallest angles. The rule is that of the command line. Rejects if it is aborted.
 */
export async function comparedRepair(
  mesher: Mesher,
  body: ProjectBody,
  loaded: LoadedSurface,
  welded: RepairProposal,
  { signal, onProgress }: { readonly signal: AbortSignal; readonly onProgress: (fraction: number) => void },
): Promise<RepairProposal> {
  const angles: { welded?: number; exact?: number } = {};
  const exact = () => proposedRepair(mesher, body, loaded, welded.wishes, { isExact: true, signal });
  const remesh = async (one: RepairProposal): Promise<{ readonly remesh: RemeshShapes }> => {
    const begin = one.isExact ? 0.5 : 0;
    const surface = { ...one.surface, points: one.surface.points.map((x) => placedLength(x, body)) };
    const made = await mesher.remeshSurface(
      surface,
      { ...body.remeshing },
      {
        signal,
        onProgress: ({ fraction }) => onProgress(begin + fraction / 2),
      },
    );
    angles[one.isExact ? "exact" : "welded"] = made.smallestAngle;
    return { remesh: made };
  };
  const { prepared } = await remeshedBest(welded, exact, remesh);
  const { welded: ofWelded = 0, exact: ofExact = null } = angles;
  return { ...prepared, comparison: { welded: ofWelded, exact: ofExact } };
}
