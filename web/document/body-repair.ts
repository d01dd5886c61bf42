import type { Diagnostic, RepairChange, RepairOptions, SurfaceInput, SurfaceInspection } from "tetrafront";
import { STEP_HEIGHT } from "tetrafront/internal";
import type { BodyRepair, ProjectBody } from "tetrafront/project";
import type { DrawnSurface } from "./drawn-surface";
import { placed } from "./placement";
import type { Position } from "./position";
import { cross, distance, dot, subtract } from "./vectors";
import { cornerOf, type Triangles } from "./winding-number";

/** What the user asks of a repair. Distances are in units of the body's own coordinates: its placement does not apply. */
export type RepairWishes = Pick<RepairOptions, "weld" | "fillHoles">;

/** Largest number of edges of a hole that is filled; the limit of the package. */
const maxHoleEdges = 200;

/**
 * Returns a body after a repair: if triangles were cut, those that would be kept are replaced, as on the command line, because cuts
 * leave needles.
 */
export function withTreatmentAfter(changes: readonly RepairChange[], body: ProjectBody): ProjectBody {
  const isCut = changes.some(({ kind }) => kind === "resolved-intersection");
  if (!isCut || body.surface !== "refine") return body;
  const { surface: _, ...remeshed } = body;
  return remeshed;
}

export const defaultRepair: RepairWishes = { weld: 0, fillHoles: maxHoleEdges };

/** Returns the distance within which a repair welds nodes of intersecting triangles: 0 if the body keeps its triangles. */
export function weldBeforeRemeshing(
  { surface = "remesh" }: ProjectBody,
  { low, high }: Pick<DrawnSurface, "low" | "high">,
): number {
  return surface === "remesh" ? STEP_HEIGHT * distance(low, high) : 0;
}

/** What a repair changes, and its result. */
export interface RepairProposal {
  readonly wishes: RepairWishes;
  readonly changes: readonly RepairChange[];
  /** Largest distance by which a node is moved, in units of the body's own coordinates: its placement does not apply. */
  readonly deviation: number;
  /** Why triangles could not be resolved, if that was tried and failed. */
  readonly unresolved: readonly Diagnostic[];
  /** Volume that parts of the surface shared, which became one; 0 if none did. As `deviation`. */
  readonly shared: number;
  /** Whether no nodes of intersecting triangles are welded. */
  readonly isExact: boolean;
  /** Whether the repair moved nodes so far that an exact one, which does not, may remesh better. */
  readonly hasWelded: boolean;
  /**
   * Smallest angles, in degrees, after a remeshing: of the repair that welds nodes, and of the exact one, null if that one was not
   * needed or failed. Null until both repairs have been compared.
   */
  readonly comparison: { readonly welded: number; readonly exact: number | null } | null;
  /** Inspection of the result. */
  readonly after: SurfaceInspection;
  readonly surface: Pick<SurfaceInput, "points" | "triangles"> & { readonly trianglePatch: Uint32Array };
  /** Whether the last patch holds the triangles of filled holes. */
  readonly hasFilled: boolean;
}

export type RepairKind = RepairChange["kind"];

/** Returns a length of the body's own coordinates in model units. */
export function placedLength(length: number, { placement }: Pick<ProjectBody, "placement">): number {
  return length * (placement?.scale ?? 1);
}

/** Returns a volume in the body's own coordinates in cubed model units. */
export function placedVolume(volume: number, body: Pick<ProjectBody, "placement">): number {
  return volume * placedLength(1, body) ** 3;
}

/** Returns a length in model units in those of the body's own coordinates. */
export function ownLength(length: number, { placement }: Pick<ProjectBody, "placement">): number {
  return length / (placement?.scale ?? 1);
}

/** Changes of one kind. */
export type RepairGroup = readonly [kind: RepairKind, changes: readonly RepairChange[]];

/** Returns the changes by their kinds, the most frequent first. */
export function repairGroups(changes: readonly RepairChange[]): readonly RepairGroup[] {
  const groups = new Map<RepairKind, RepairChange[]>();
  for (const change of changes) {
    const known = groups.get(change.kind);
    if (known) known.push(change);
    else groups.set(change.kind, [change]);
  }
  return [...groups].sort(([, a], [, b]) => b.length - a.length);
}

/** Largest number of positions that the project stores of the changes of one kind. */
const maxPositions = 100;

/** Returns the repairs of a body after a further one, and the sum of their deviations. */
export function withRepairs(
  { repairs = [], repairDeviation = 0 }: ProjectBody,
  { changes, deviation }: Pick<RepairProposal, "changes" | "deviation">,
): { readonly repairs: readonly BodyRepair[]; readonly repairDeviation?: number } {
  const known = new Map(repairs.map((repair) => [repair.kind, repair]));
  for (const [kind, group] of repairGroups(changes)) {
    const before = known.get(kind) ?? { kind, count: 0, positions: [] };
    const positions = [...before.positions, ...group.map(({ position }) => position)];
    known.set(kind, {
      kind,
      count: before.count + group.length,
      positions: positions.slice(0, maxPositions),
    });
  }
  const moved = repairDeviation + deviation;
  // Both describe the same triangles: an operation that makes others must replace both.
  return { repairs: [...known.values()], ...(moved > 0 && { repairDeviation: moved }) };
}

/** Returns the repairs of bodies that become one without a placement; their deviation is the largest one. */
export function joinedRepairs(
  bodies: readonly ProjectBody[],
): Pick<ProjectBody, "repairs" | "repairDeviation"> {
  const known = new Map<RepairKind, BodyRepair>();
  for (const body of bodies) {
    for (const { kind, count, positions } of body.repairs ?? []) {
      const before = known.get(kind) ?? { kind, count: 0, positions: [] };
      const moved = positions.map((position) => placed(position, body.placement ?? {}));
      known.set(kind, {
        kind,
        count: before.count + count,
        positions: [...before.positions, ...moved].slice(0, maxPositions),
      });
    }
  }
  const deviation = Math.max(0, ...bodies.map((body) => placedLength(body.repairDeviation ?? 0, body)));
  return {
    ...(known.size > 0 && { repairs: [...known.values()] }),
    ...(deviation > 0 && { repairDeviation: deviation }),
  };
}

/** Smallest shared volume / volume that is not due to rounding, or to curved faces that touch. */
const smallestShare = 1e-4;

/** Returns a volume that parts share; 0 if it is too small beside the volume of all. */
export const sharedAbove = (shared: number, volume: number): number =>
  shared > smallestShare * volume ? shared : 0;

/**
 * Returns the volume that parts of a closed surface share, if all face outward: what they enclose one by one beyond `volume`,
 * that of the repaired surface.
 */
export function sharedVolume({ points, triangles }: Triangles, volume: number): number {
  const origin = cornerOf(points, triangles[0] ?? 0);
  const corner = (index: number): Position => subtract(cornerOf(points, triangles[index] ?? 0), origin);
  let sixfold = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    sixfold += dot(corner(t), cross(corner(t + 1), corner(t + 2)));
  }
  return sharedAbove(sixfold / 6 - volume, volume);
}
