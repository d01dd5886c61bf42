/** Repairs requested on the command line, and the list of their changes. */
import type { Mesher } from "../api/mesher-interface.js";
import type { RepairOptions } from "../api/option-types.js";
import { withoutFilledPatch } from "../api/filled-holes.js";
import { checkRepairOptions } from "../api/options.js";
import { repairedSurface } from "../api/repaired-surface.js";
import { overlapWarning, touchingPairs, touchingSolids } from "../api/touching-solids.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { STEP_HEIGHT } from "../base/limits.js";
import { plural } from "../base/plural.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import type { InnerShells } from "../generated/constants.js";
import type { RepairChange, SurfaceInspection, SurfaceRepair } from "../mesh/inspection.js";
import { joinedBodies, overlappingSolids } from "./overlaps.js";
import { crackWarning } from "./cracks.js";
import { hasSolids, withoutRegions } from "./solid-regions.js";
import { checkedSolids, type Solids, withSolidRegions } from "./solids.js";
import { numberIn, refuseOptions } from "./input.js";
import { hasRegionVolumes } from "../api/input-checks.js";
import { diagonalOf } from "../formats/near-points.js";
import { InvalidInput, print } from "./messages.js";
import { positionText, short } from "./tables.js";

/** Options as commander passes them. */
export interface RepairCommandOptions {
  readonly repair?: boolean;
  readonly weld?: string;
  readonly fillHoles?: string;
  readonly innerShells?: InnerShells;
}

export interface RepairedSurface {
  readonly surface: SurfaceFile;
  /** Undefined if no repair was requested. */
  readonly changes?: readonly RepairChange[] | undefined;
  /** Largest distance by which the repair moved a node, in model units; as `changes`. */
  readonly repairDeviation?: number | undefined;
  /** About solids that overlap, bodies that were joined, and what could not be resolved. */
  readonly warnings?: readonly Diagnostic[];
}

/** Returns the options of a repair, undefined if none is requested. Throws an InvalidInput. */
export function repairOptions(given: RepairCommandOptions): RepairOptions | undefined {
  const { repair = false, weld, fillHoles, innerShells } = given;
  if (!repair && weld === undefined && fillHoles === undefined) return undefined;
  const options: RepairOptions = {
    ...(weld === undefined ? {} : { weld: numberIn(weld) }),
    ...(fillHoles === undefined ? {} : { fillHoles: numberIn(fillHoles) }),
    innerShells,
  };
  refuseOptions(checkRepairOptions(options));
  return options;
}

/** Throws an InvalidInput if a repair is requested for input that is not a surface. */
export function refuseRepair(options: RepairOptions | undefined, what: string): void {
  if (options === undefined) return;
  const message = `repairs are for surfaces, but the input is ${what}`;
  const remedy = "Omit --repair, --weld and --fill-holes.";
  refuseOptions([invalidOption("--repair", message, remedy)]);
}

export async function repaired(
  mesher: Mesher,
  given: SurfaceFile,
  options: RepairOptions | undefined,
): Promise<RepairedSurface> {
  if (options === undefined) return { surface: given };
  const repair = await withinLimit(mesher, given, options);
  const { changes, deviation: repairDeviation, diagnostics } = repair;
  const surface = repairedSurface(given, repair);
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
  mesher: Mesher,
  given: SurfaceFile,
  made: SurfaceFile,
  { changes, surface }: SurfaceRepair,
  innerShells: InnerShells | undefined,
): Promise<Diagnostic[]> {
  const isCut = changes.some(({ kind }) => kind === "resolved-intersection");
  const isOneRegion = (given.surfaceRegions?.regions.length ?? 0) < 2;
  if (!isCut || !isOneRegion) return [];
  const { volume } = await mesher.inspectSurface(made, { innerShells });
  return joinedBodies(mesher, given, surface, volume);
}

/** Returns the surface after a repair with the regions of its solids. `before` and `found`: inspections, without regions. */
async function solidsOfRepair(
  mesher: Mesher,
  given: SurfaceFile,
  surface: SurfaceFile,
  repair: SurfaceRepair,
  { before, found }: { readonly before: SurfaceInspection; readonly found: SurfaceInspection },
): Promise<Solids> {
  const touching = touchingPairs(given.surfaceRegions, before.diagnostics);
  const isAssigned = repair.surface.givenRegions !== undefined;
  return isAssigned
    ? withSolidRegions(mesher, given, surface, { touching, overlaps: [], assigned: repair.sharedVolumes })
    : withSolidRegions(mesher, given, surface, {
        touching,
        overlaps: await overlappingSolids(mesher, given, touching, found),
      });
}

/**
 * Repairs a surface. A limit of holes that is given holds for all of them: if larger ones were closed to resolve the rest, they
 * stay open, and nothing is resolved.
 */
async function withinLimit(
  mesher: Mesher,
  given: SurfaceFile,
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
  /** Subject of messages. */
  readonly input: string;
  /** The repair that is requested, if any. */
  readonly repair: RepairOptions | undefined;
  readonly innerShells: InnerShells | undefined;
  /** Whether the surface is repaired if it cannot be filled without. */
  readonly isRepairImplied: boolean;
  readonly isRemeshed: boolean;
  /** Whether no nodes are welded before the remeshing. */
  readonly isExact?: boolean | undefined;
}

/** Returns the surface after the repair that is requested or implied. Throws an InvalidInput. */
export async function preparedSurface(
  mesher: Mesher,
  given: SurfaceFile,
  preparation: Preparation,
): Promise<RepairedSurface> {
  const { input, repair, innerShells, isRepairImplied } = preparation;
  if (isRepairImplied) return madeFillable(mesher, given, input, preparation);
  const isChecked = repair === undefined && hasSolids(given);
  return isChecked ? checkedSolids(mesher, given, input, innerShells) : repaired(mesher, given, repair);
}

/**
 * Returns the surface, repaired if it cannot be filled without, with a warning about solids that overlap. Throws an
 * InvalidInput if the triangles of different solids still intersect. `isRemeshed`: whether the surface will be remeshed:
 * then nodes of intersecting triangles are welded, unless the repair is `isExact`.
 */
export async function madeFillable(
  mesher: Mesher,
  given: SurfaceFile,
  input: string,
  {
    innerShells,
    isRemeshed,
    isExact = false,
  }: {
    readonly innerShells: InnerShells | undefined;
    readonly isRemeshed: boolean;
    readonly isExact?: boolean | undefined;
  },
): Promise<RepairedSurface> {
  const before = await mesher.inspectSurface(given, { innerShells });
  if (before.isFillable)
    return hasSolids(given) ? withSolidRegions(mesher, given, given) : { surface: given };
  const weldIntersections = isRemeshed && !isExact ? STEP_HEIGHT * diagonalOf(given.points) : 0;
  const repair = await withinLimit(mesher, given, { innerShells, weldIntersections });
  const { changes, deviation: repairDeviation, diagnostics } = repair;
  const made = repairedSurface(withoutRegions(given), repair);
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
    : await overlappingSolids(mesher, given, touchingPairs(given.surfaceRegions, before.diagnostics), found);
  const hasHoles = changes.some(({ kind }) => kind === "filled-hole") || before.openEdges > 0;
  const cracks = hasHoles && !hasSolids(given) ? await crackWarning(mesher, given, found, innerShells) : [];
  const warnings = [
    ...diagnostics,
    ...joined,
    ...cracks,
    ...(isChanged && solids === undefined && hasRegionVolumes(given) ? [limitsLost()] : []),
    ...(solids?.warnings ?? overlaps.map((overlap) => overlapWarning(given.surfaceRegions, overlap))),
  ];
  const touching = found.isFillable ? [] : touchingSolids(given.surfaceRegions, found.diagnostics);
  if (touching.length > 0) throw new InvalidInput(input, touching);
  return isChanged || solids !== undefined
    ? { surface: solids?.surface ?? surface, changes, repairDeviation, warnings }
    : { surface: given, warnings };
}

function limitsLost(): Diagnostic {
  const message = "the largest volumes of regions have no effect, because the surface was repaired";
  const remedy = "Use --max-volume, which limits all tetrahedra.";
  return packageDiagnostic("region-point", message, remedy, "warning");
}

/** Largest number of lines per kind of change; `--json` and `--report` list all. */
const MAX_PER_KIND = 20;

/** Number of significant digits of a deviation. */
const DIGITS = 3;

/** Prints one line per change, one per kind that has more, and the largest distance by which a node was moved. */
export function printChanges(
  input: string,
  { changes, repairDeviation = 0 }: Pick<RepairedSurface, "changes" | "repairDeviation">,
  onLine: (line: string) => void = print,
): void {
  if (changes === undefined) return;
  if (changes.length === 0) return onLine(`repair: ${input}: nothing to repair`);
  const kinds = new Map<RepairChange["kind"], RepairChange[]>();
  for (const change of changes) {
    const known = kinds.get(change.kind);
    if (known === undefined) kinds.set(change.kind, [change]);
    else known.push(change);
  }
  for (const [kind, all] of kinds) {
    for (const change of all.slice(0, MAX_PER_KIND)) onLine(`repair: ${input}: ${sentenceOf(change)}.`);
    const rest = all.length - MAX_PER_KIND;
    if (rest > 0) onLine(`repair: ${input}: and ${rest} more "${kind}".`);
  }
  const moved =
    repairDeviation === 0
      ? "no node was moved"
      : `nodes were moved by at most ${short(repairDeviation, DIGITS)}`;
  onLine(`repair: ${input}: ${plural(changes.length, "change")}; ${moved}.`);
}

/** Describes a change with ids and position. */
export function sentenceOf(change: RepairChange): string {
  return `${words()} at ${positionText(change.position)}`;

  function words(): string {
    switch (change.kind) {
      case "welded-node":
        return `welded node ${change.node} to node ${change.into}`;
      case "removed-node":
        return `removed node ${change.node}, which no triangle uses`;
      case "removed-triangle":
        return `removed triangle ${change.triangle}, which has no area`;
      case "removed-duplicate":
        return `removed triangle ${change.triangle}, a duplicate of triangle ${change.sameAs}`;
      case "split-triangle":
        return `split triangle ${change.beyond} to replace triangle ${change.triangle}, which has no area`;
      case "filled-hole":
        return `filled a hole with ${plural(change.triangles, "triangle")}, from triangle ${change.firstTriangle} on`;
      case "flipped-triangle":
        return `flipped triangle ${change.triangle}`;
      case "resolved-intersection":
        return change.parts === 0
          ? `removed triangle ${change.triangle}, which intersected others and is inside, or encloses nothing`
          : `cut triangle ${change.triangle}, which intersected others; ${plural(change.parts, "part")} of it remain${change.parts === 1 ? "s" : ""}`;
      case "removed-sheet":
        return `removed triangle ${change.triangle}, which enclosed nothing`;
    }
  }
}
