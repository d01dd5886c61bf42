/** Makes a surface of a file ready for meshing: its repair, its solids, its patches by angle and its region points. */
import { STEP_HEIGHT } from "../base/limits.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { inSteps } from "../calls/yielder.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { diagonalOf } from "../formats/near-points.js";
import { type InnerShells, MAX_LENGTH } from "../generated/constants.js";
import type { RepairChange, SurfaceInspection, SurfaceRepair } from "../mesh/inspection.js";
import { withoutFilledPatch } from "./filled-holes.js";
import { hasRegionVolumes } from "./input-checks.js";
import { nearNodeWeld } from "./near-nodes.js";
import type { RepairOptions } from "./option-types.js";
import { hasSolids, withoutRegions } from "./stated-solids.js";
import type { Solids } from "./solids.js";
import type { SurfaceMesher } from "./surface-mesher.js";
import { overlapWarning, touchingPairs, touchingSolids } from "./touching-solids.js";
import { isVisiblyChanged, keepsTriangles } from "./visible-change.js";
import type { Mesh } from "../mesh/mesh.js";

/** Loaded when they are needed: most surfaces have one solid. */
const ofSolids = () => import("./solids.js");
const ofOverlaps = () => import("./overlaps.js");

export interface PreparedSurface {
  readonly surface: Mesh;
  /** Undefined if no repair was requested. */
  readonly changes?: readonly RepairChange[] | undefined;
  /** Largest distance by which the repair moved a node, in model units; as `changes`. */
  readonly repairDeviation?: number | undefined;
  /** About solids that overlap, bodies that were joined, and what could not be resolved. */
  readonly warnings?: readonly Diagnostic[];
}

export async function repaired(
  mesher: SurfaceMesher,
  given: Mesh,
  options: RepairOptions | undefined,
): Promise<PreparedSurface> {
  if (options === undefined) return { surface: given };
  const repair = (await weldedCracks(mesher, given, options)) ?? (await withinLimit(mesher, given, options));
  const { mesh: surface, changes, deviation: repairDeviation, diagnostics } = repair;
  if (hasSolids(given)) {
    const before = await mesher.inspectSurface(withoutRegions(given));
    const found = await mesher.inspectSurface(withoutRegions(surface));
    if (found.isFillable) {
      const made = await solidsOfRepair(mesher, given, surface, repair, { before, found });
      return {
        surface: made.surface,
        changes,
        repairDeviation,
        warnings: [...diagnostics, ...made.warnings],
      };
    }
  }
  const joined = await joinedByRepair(mesher, given, surface, repair, options.innerShells);
  return { surface, changes, repairDeviation, warnings: [...diagnostics, ...joined] };
}

/** Returns a note if bodies of one region were joined. */
async function joinedByRepair(
  mesher: SurfaceMesher,
  given: Mesh,
  made: Mesh,
  { changes }: SurfaceRepair,
  innerShells: InnerShells | undefined,
): Promise<Diagnostic[]> {
  const isCut = changes.some(({ kind }) => kind === "resolved-intersection");
  const isOneRegion = (given.surfaceRegions?.regions.length ?? 0) < 2;
  if (!isCut || !isOneRegion) return [];
  const { volume } = await mesher.inspectSurface(made, { innerShells });
  return (await ofOverlaps()).joinedBodies(mesher, given, made, volume);
}

/** Returns the surface after a repair with the regions of its solids. `before` and `found`: inspections, without regions. */
async function solidsOfRepair(
  mesher: SurfaceMesher,
  given: Mesh,
  surface: Mesh,
  repair: SurfaceRepair,
  { before, found }: { readonly before: SurfaceInspection; readonly found: SurfaceInspection },
): Promise<Solids> {
  const touching = touchingPairs(given.surfaceRegions, before.diagnostics);
  const { withSolidRegions } = await ofSolids();
  return repair.isSeparated
    ? withSolidRegions(mesher, given, surface, { touching, overlaps: [], assigned: repair.sharedVolumes })
    : withSolidRegions(mesher, given, surface, {
        touching,
        overlaps: await (await ofOverlaps()).overlappingSolids(mesher, given, touching, found),
      });
}

/**
 * Welds the nodes along cracks whose nodes nearly coincide, in place of cutting triangles that cross there. Returns undefined if
 * there are none, if a distance is given, or if this alone does not make the surface valid.
 */
async function weldedCracks(
  mesher: SurfaceMesher,
  given: Mesh,
  options: RepairOptions,
): Promise<SurfaceRepair | undefined> {
  if (options.weld !== undefined) return undefined;
  const weld = await inSteps(nearNodeWeld(given));
  if (weld === 0) return undefined;
  const repair = await mesher.repairSurface(given, { ...options, weld, resolveIntersections: false });
  if (!keepsTriangles(repair)) return undefined;
  const { isFillable } = await mesher.inspectSurface(withoutRegions(repair.mesh), {
    innerShells: options.innerShells,
  });
  return isFillable ? repair : undefined;
}

/**
 * Whether a repair can mend this fault of a closed surface and keep every triangle: some are there twice, or face the wrong way. One
 * between two regions may be meant so.
 */
const isSmallFault = ({ code, data }: Diagnostic): boolean =>
  code === "duplicate-triangle" || (code === "flipped-triangle" && !data.isBetweenRegions);

/**
 * Removes triangles that are there twice and flips those that face the wrong way. Returns undefined if there are none, or if this
 * alone does not make the surface valid.
 */
async function withTrianglesMended(
  mesher: SurfaceMesher,
  given: Mesh,
  innerShells: InnerShells | undefined,
): Promise<SurfaceRepair | undefined> {
  const { openEdges, diagnostics } = await mesher.inspectSurface(given, { innerShells });
  if (openEdges > 0 || !diagnostics.some(isSmallFault)) return undefined;
  const repair = await mesher.repairSurface(given, { innerShells, resolveIntersections: false });
  if (!keepsTriangles(repair)) return undefined;
  const after = await mesher.inspectSurface(withoutRegions(repair.mesh), { innerShells });
  return after.isFillable ? repair : undefined;
}

/**
 * Repairs a surface. A limit of holes that is given holds for all of them: if larger ones were closed to resolve the rest, they
 * stay open, and nothing is resolved.
 */
async function withinLimit(
  mesher: SurfaceMesher,
  given: Mesh,
  options: RepairOptions,
): Promise<SurfaceRepair> {
  const repair = await mesher.repairSurface(given, options);
  const { fillHoles } = options;
  if (fillHoles === undefined) return repair;
  // A hole of n edges is filled with n - 2 triangles.
  const isBeyond = repair.changes.some(
    (change) => change.kind === "filled-hole" && change.triangles + 2 > fillHoles,
  );
  return isBeyond ? mesher.repairSurface(given, { ...options, resolveIntersections: false }) : repair;
}

/** How a surface is made ready for meshing. */
export interface Preparation {
  /** The repair that is requested, if any. */
  readonly repair: RepairOptions | undefined;
  readonly innerShells: InnerShells | undefined;
  /** Whether the surface is repaired if it cannot be filled without. */
  readonly isRepairImplied: boolean;
  readonly isRemeshed: boolean;
  /** Whether no nodes are welded before the remeshing. */
  readonly isExact?: boolean | undefined;
}

/** Returns the surface after the repair that is requested or implied. Rejects with `invalid-input`. */
export async function preparedSurface(
  mesher: SurfaceMesher,
  given: Mesh,
  preparation: Preparation,
): Promise<PreparedSurface> {
  const { repair, innerShells, isRepairImplied } = preparation;
  if (isRepairImplied) return madeFillable(mesher, given, preparation);
  const isChecked = repair === undefined && hasSolids(given);
  return isChecked
    ? (await ofSolids()).checkedSolids(mesher, given, innerShells)
    : repaired(mesher, given, repair);
}

/**
 * Returns the surface, repaired if it cannot be filled without, with a warning about solids that overlap. Rejects with
 * `invalid-input` if the triangles of different solids still intersect. `isRemeshed`: whether the surface will be remeshed:
 * then nodes of intersecting triangles are welded, unless the repair is `isExact`.
 */
export async function madeFillable(
  mesher: SurfaceMesher,
  given: Mesh,
  {
    innerShells,
    isRemeshed,
    isExact = false,
  }: {
    readonly innerShells: InnerShells | undefined;
    readonly isRemeshed: boolean;
    readonly isExact?: boolean | undefined;
  },
): Promise<PreparedSurface> {
  const before = await mesher.inspectSurface(given, { innerShells });
  if (before.isFillable)
    return hasSolids(given) ? (await ofSolids()).withSolidRegions(mesher, given, given) : { surface: given };
  const areNested =
    hasSolids(given) && before.diagnostics.some(({ code }) => code === "inconsistent-regions");
  if (areNested && (await mesher.inspectSurface(withoutRegions(given), { innerShells })).isFillable)
    return (await ofSolids()).withSolidRegions(mesher, given, given);
  const step = STEP_HEIGHT * diagonalOf(given.points);
  // The inspection says what is wrong with coordinates that are too large.
  const weldIntersections = isRemeshed && !isExact && step <= MAX_LENGTH ? step : 0;
  const wanted = { innerShells, weldIntersections };
  const repair = (await weldedCracks(mesher, given, wanted)) ?? (await withinLimit(mesher, given, wanted));
  const { changes, deviation: repairDeviation, diagnostics } = repair;
  const made = repair.isSeparated ? repair.mesh : withoutRegions(repair.mesh);
  const joined = await joinedByRepair(mesher, given, made, repair, innerShells);
  const surface = withoutFilledPatch(made);
  const found = await mesher.inspectSurface(withoutRegions(surface), { innerShells });
  const isChanged = changes.length > 0;
  const isOfSolids = found.isFillable && hasSolids(given);
  const solids = isOfSolids
    ? await solidsOfRepair(mesher, given, surface, repair, { before, found })
    : undefined;
  const overlaps = isOfSolids
    ? []
    : await (
        await ofOverlaps()
      ).overlappingSolids(mesher, given, touchingPairs(given.surfaceRegions, before.diagnostics), found);
  const hasHoles = changes.some(({ kind }) => kind === "filled-hole") || before.openEdges > 0;
  const cracks =
    hasHoles && !hasSolids(given)
      ? await (await import("./cracks.js")).crackWarning(mesher, given, found, innerShells)
      : [];
  const warnings = [
    ...diagnostics,
    ...joined,
    ...cracks,
    ...(isChanged && solids === undefined && hasRegionVolumes(given) ? [limitsLost()] : []),
    ...(solids?.warnings ?? overlaps.map((overlap) => overlapWarning(given.surfaceRegions, overlap))),
  ];
  const touching = found.isFillable ? [] : touchingSolids(given.surfaceRegions, found.diagnostics);
  refuse(touching);
  return isChanged || solids !== undefined
    ? { surface: solids?.surface ?? surface, changes, repairDeviation, warnings }
    : { surface: given, warnings };
}

/**
 * Returns a surface after a repair that keeps its triangles: cracks are welded, triangles that were there twice are removed, as where
 * two shells have a face in common, and those that face the wrong way are flipped. Undefined if nothing is to be done, if this does not make it valid, or if one would see it.
 */
export async function withSmallRepair(
  mesher: SurfaceMesher,
  given: Mesh,
  innerShells: InnerShells | undefined,
): Promise<PreparedSurface | undefined> {
  const repair =
    (await weldedCracks(mesher, given, { innerShells })) ??
    (await withTrianglesMended(mesher, given, innerShells));
  if (repair === undefined) return undefined;
  const { mesh: welded, changes, deviation: repairDeviation } = repair;
  const solids = hasSolids(given)
    ? await (await ofSolids()).withSolidRegions(mesher, given, welded)
    : undefined;
  const surface = solids?.surface ?? welded;
  const warnings = [...repair.diagnostics, ...(solids?.warnings ?? [])];
  const made = { surface, changes, repairDeviation, warnings };
  return isVisiblyChanged(given, made) ? undefined : made;
}

function limitsLost(): Diagnostic {
  const message = "the largest volumes of regions have no effect, because the surface was repaired";
  const remedy = "Use `maxVolume`, which limits all tetrahedra.";
  return packageDiagnostic("region-point", message, remedy, "warning");
}
