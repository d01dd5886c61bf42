import {
  type SurfaceRegions,
  type Mesher,
  NO_REGION,
  type Mesh,
  type SurfaceInput,
  type SurfaceRepair,
} from "tetrafront";
import { connectedGroups, nearPairs } from "tetrafront/internal";
import type { Project, ProjectBody } from "tetrafront/project";
import { nextBodyIds, usedPatches } from "../document/body-edits";
import {
  joinedRepairs,
  sharedAbove,
  weldBeforeRemeshing,
  withRepairs,
  withTreatmentAfter,
} from "../document/body-repair";
import { placedSurfaceKey } from "../document/content-keys";
import { joinedHead, joinedPatches, joinedSurface, placedSurface } from "../document/touching-bodies";
import { strings } from "../strings";
import type { PatchArrays } from "../document/patch-arrays";
import { boxOf } from "../document/vectors";

/** A body and its given triangles, which are not placed. */
export interface GivenBody {
  readonly body: ProjectBody;
  readonly surface: PatchArrays;
  /** What it encloses at its placement. */
  readonly volume: number;
  /** Number of regions that it encloses. */
  readonly regions: number;
  /** Whether it is one region, and all its triangles face outward. */
  readonly isPlain: boolean;
}

/** Bodies that touch or intersect, directly or through others. */
export type TouchingBodies = readonly GivenBody[];

/** Number of results that are kept beside those of the present pairs, so that undo needs no inspection. */
const maxOtherPairs = 1000;

/**
 * Inspects pairs of bodies, and remembers the results: a pair is inspected again only after the given triangles or the
 * placement of one of its bodies have changed.
 */
export class BodyPairs {
  /** Whether two bodies touch, by the keys of both. The results used last are at the end. */
  readonly #known = new Map<string, boolean>();

  /**
   * Returns the groups of bodies that touch or intersect: two bodies that can be filled alone, but not together. Bodies that
   * cannot be filled alone are ignored. O(n log n) per pair to inspect: one whose boxes are not apart.
   */
  async touching(
    mesher: Mesher,
    bodies: readonly GivenBody[],
    signal: AbortSignal,
  ): Promise<TouchingBodies[]> {
    const surfaces = bodies.map(({ body, surface }) => placedSurface(surface, body));
    const pairs = nearPairs(surfaces.map(({ points }) => boxOf(points)));
    const touching: (readonly [number, number])[] = [];
    for (const pair of pairs) {
      const given = pair.flatMap((index) => bodies[index] ?? []);
      const key = given.map(({ body }) => placedSurfaceKey(body)).join(" | ");
      const isTouching = this.#known.get(key) ?? (await isOverlap(mesher, given, signal));
      signal.throwIfAborted();
      this.#known.delete(key);
      this.#known.set(key, isTouching);
      if (isTouching) touching.push(pair);
    }
    const others = this.#known.size - pairs.length;
    for (const key of [...this.#known.keys()].slice(0, Math.max(0, others - maxOtherPairs))) {
      this.#known.delete(key);
    }
    const groups = connectedGroups(bodies.length, touching).filter(({ length }) => length > 1);
    return groups.map((group) => group.flatMap((index) => bodies[index] ?? []));
  }
}

/** Returns whether bodies cannot be filled together. */
async function isOverlap(
  mesher: Mesher,
  bodies: readonly GivenBody[],
  signal: AbortSignal,
): Promise<boolean> {
  const parts = bodies.map(
    ({ body, surface }) => [placedSurface(surface, body), body.patches.length] as const,
  );
  const { isFillable } = await mesher.inspectSurface(joinedSurface(parts), {}, { signal });
  return !isFillable;
}

/** A body that consists of several that touch. */
export interface JoinedBody {
  readonly body: ProjectBody;
  readonly surface: PatchArrays;
  /** Number of regions that it encloses. */
  readonly regions: number;
  /** Volume that several of the bodies enclose; 0 if they only touch. */
  readonly shared: number;
}

/**
 * Returns bodies that touch as one body: their triangles are cut where they intersect and common where they touch, which
 * leaves what each body encloses as a region, or as several. A volume that they share belongs to the first of them, as on the
 * command line; if a body with several regions, or with triangles that face inward, has a cavity or is invalid where it is
 * placed, bodies that share a volume become one region. Null if they cannot be joined.
 */
export async function joinedBody(
  mesher: Mesher,
  project: Project,
  group: TouchingBodies,
  signal: AbortSignal,
): Promise<JoinedBody | null> {
  const bodies = group.map(({ body }) => body);
  const divided: DividedBody[] = [];
  for (const one of group) divided.push(await dividedBody(mesher, one, signal));
  const given = joinedSurface(
    divided.map(({ surface }, index) => [surface, bodies[index]?.patches.length ?? 0]),
  );
  const head = joinedHead(project, bodies);
  const own = joinedPatches(group);
  const empty = { ...head, ...joinedRepairs(bodies), points: "", triangles: "", patches: own };
  const surfaceRegions = regionsOf(divided);
  const patches = own.map(({ id, name = "" }) => ({ name, tag: id }));
  const input = { ...given, patches, ...(surfaceRegions && { surfaceRegions }) };
  const { body, repair } = await cut(mesher, empty, input, signal);
  const { points, triangles, trianglePatch } = repair.mesh;
  const after = await mesher.inspectSurface({ points, triangles }, {}, { signal });
  if (!after.isFillable) return null;
  const filled = { id: nextBodyIds(project).firstPatchId, name: strings.bodies.repair.filledPatch };
  const used = usedPatches([...own, filled], trianglePatch);
  const volume = group.reduce((sum, one) => sum + one.volume, 0);
  return {
    body: { ...body, ...withRepairs(body, repair), patches: used.patches },
    surface: { points, triangles, trianglePatch: used.trianglePatch },
    regions: after.regions,
    shared: sharedAbove(volume - after.volume, after.volume),
  };
}

/** Cuts the triangles of bodies that became one, and decides what becomes of them. */
async function cut(
  mesher: Mesher,
  body: ProjectBody,
  input: SurfaceInput,
  signal: AbortSignal,
): Promise<{ readonly body: ProjectBody; readonly repair: SurfaceRepair }> {
  const weldIntersections = weldBeforeRemeshing(body, boxOf(input.points));
  const repair = await mesher.repairSurface(input, { weldIntersections }, { signal });
  const treated = withTreatmentAfter(repair.changes, body);
  return treated === body ? { body, repair } : cut(mesher, treated, input, signal);
}

/** Placed triangles of a body, and the regions beside them. */
interface DividedBody {
  readonly surface: PatchArrays;
  readonly regions: number;
  /** Two per triangle: the region behind it and that in front. Null if volumes of the body are empty. */
  readonly sides: Uint32Array | null;
}

/** Finds the regions of a body. They stay unknown if it encloses other volumes too, or is invalid where it is placed. */
async function dividedBody(
  mesher: Mesher,
  { body, surface, regions, isPlain }: GivenBody,
  signal: AbortSignal,
): Promise<DividedBody> {
  const placed = placedSurface(surface, body);
  if (isPlain) {
    const sides = Uint32Array.from(Array.from(placed.trianglePatch, () => [0, NO_REGION]).flat());
    return { surface: placed, regions, sides };
  }
  const patches = body.patches.map(({ id, name = "" }) => ({ name, tag: id }));
  const located = await locatedRegions(mesher, { ...placed, patches }, signal);
  const sides = located?.surfaceRegions?.triangleRegions ?? new Uint32Array();
  const isFull = located?.surfaceRegions?.regions.length === regions;
  return located && isFull ? { surface: located, regions, sides } : { surface: placed, regions, sides: null };
}

/** Locates the regions of a surface. Null if it is invalid: rounding can make a body that was rotated intersect itself. */
async function locatedRegions(
  mesher: Mesher,
  surface: SurfaceInput,
  signal: AbortSignal,
): Promise<Mesh | null> {
  try {
    return (await mesher.locateRegions(surface, { signal })).mesh;
  } catch (error) {
    if (signal.aborted) throw error;
    return null;
  }
}

/** Returns the regions beside the triangles of joined bodies, those of the first body first; null if some are unknown. */
function regionsOf(divided: readonly DividedBody[]): SurfaceRegions | null {
  const all: number[] = [];
  let count = 0;
  for (const { regions, sides } of divided) {
    if (sides === null) return null;
    for (const region of sides) all.push(region === NO_REGION ? NO_REGION : count + region);
    count += regions;
  }
  const regions = Array.from({ length: count }, (_, r) => ({ name: `region ${r + 1}`, tag: r + 1 }));
  return { regions, triangleRegions: Uint32Array.from(all), areMeshed: true };
}
