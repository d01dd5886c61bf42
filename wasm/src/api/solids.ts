/** What becomes of the solids of a surface: regions, overlaps, and gaps between them. */
import {
  assignedOverlap,
  innerSolid,
  mergeWarning,
  type Overlap,
  overlapWarning,
  type TouchingPair,
  touchingSolids,
} from "./touching-solids.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { NO_REGION, type InnerShells } from "../generated/constants.js";
import type { Mesh, SurfaceRegions } from "../mesh/mesh.js";
import type { SharedVolume } from "../mesh/inspection.js";
import { almostTouching } from "./near-solids.js";
import { solidOf } from "./overlaps.js";
import type { SurfaceMesher } from "./surface-mesher.js";
import { type CommonVolume, solidRegions } from "./solid-regions.js";
import { withoutRegions } from "./stated-solids.js";

export interface Solids {
  readonly surface: Mesh;
  readonly warnings: readonly Diagnostic[];
}

/** What is known about the solids before. */
interface Known {
  /** Pairs whose triangles intersect, and those of them that share a volume. */
  readonly touching: readonly TouchingPair[];
  readonly overlaps: readonly Overlap[];
  /** What a repair has assigned to one solid of several; undefined if it has assigned nothing. */
  readonly assigned?: readonly SharedVolume[] | undefined;
}

/**
 * Returns a surface that can be filled with the regions of its solids, and what the user should know: solids that overlap, or
 * almost touch. `made`: the given surface, or the result of its repair.
 */
export async function withSolidRegions(
  mesher: SurfaceMesher,
  given: Mesh,
  made: Mesh,
  { touching, overlaps, assigned }: Known = { touching: [], overlaps: [] },
): Promise<Solids> {
  const { surface, gaps, shared } = await solidRegions(mesher, given, made, assigned !== undefined);
  // Includes NO_REGION, for the outside.
  const left = new Set(surface.surfaceRegions?.triangleRegions);
  const all = [...overlaps, ...shared.flatMap((volume) => overlapsIn(given, volume, overlaps))];
  const isLeft = (region: number) => left.has(region);
  const intoOf = (pair: readonly number[]) =>
    shared.find(({ regions }) => pair.every((region) => regions.includes(region)))?.regions[0];
  // Solids that overlap by next to nothing lose their regions too.
  const isTold = new Set(all.flatMap(({ regions }) => [...regions]));
  const merged = shared.filter(({ regions }) => regions.some((one) => !isLeft(one) && !isTold.has(one)));
  const told = (assigned ?? []).map((one) => assignedDiagnostic(given, one, isLeft));
  // A solid inside another one has it on its outer side, which the given regions do not state.
  const isStated = haveSameSides(given.surfaceRegions, surface.surfaceRegions);
  const isKept = made === given && shared.length === 0 && isStated;
  return {
    surface: isKept ? given : surface,
    warnings: [
      ...all.map((overlap) =>
        overlapWarning(given.surfaceRegions, overlap, { isLeft, into: intoOf(overlap.regions) }),
      ),
      ...told,
      ...merged.map(({ regions, position }) => mergeWarning(given.surfaceRegions, regions, position)),
      ...gaps,
      ...almostTouching(surface, [...touching, ...all, ...(assigned ?? [])]),
    ],
  };
}

function haveSameSides(one: SurfaceRegions | undefined, other: SurfaceRegions | undefined): boolean {
  const [a, b] = [one?.triangleRegions ?? [], other?.triangleRegions ?? []];
  return a.length === b.length && a.every((region, side) => region === b[side]);
}

/** Returns a surface without the solids that lie wholly inside another one, which bound cavities then; one inside of such a cavity stays. O(n). */
export function withCavities(surface: Mesh): Mesh {
  const { surfaceRegions } = surface;
  if (surfaceRegions?.areMeshed !== true) return surface;
  const { triangleRegions: sides } = surfaceRegions;
  const around = surfaceRegions.regions.map(() => new Set<number>());
  sides.forEach((region, side) => around[region]?.add(sides[side ^ 1] ?? NO_REGION));
  const isCavity = (region: number, inner: readonly number[] = []): boolean => {
    const [outer = NO_REGION, ...more] = around[region] ?? [];
    const isInside = outer !== NO_REGION && more.length === 0 && !inner.includes(outer);
    return isInside && !isCavity(outer, [...inner, region]);
  };
  const cavities = new Set([...around.keys()].filter((region) => isCavity(region)));
  if (cavities.size === 0) return surface;
  const triangles = surface.triangles.slice();
  const triangleRegions = sides.map((region) => (cavities.has(region) ? NO_REGION : region));
  for (let t = 0; 2 * t < sides.length; t++) {
    if (triangleRegions[2 * t] !== NO_REGION) continue;
    triangles.subarray(3 * t, 3 * t + 3).reverse();
    triangleRegions.subarray(2 * t, 2 * t + 2).reverse();
  }
  return { ...surface, triangles, surfaceRegions: { ...surfaceRegions, triangleRegions } };
}

/** Says which solid got a volume that two shared. */
function assignedDiagnostic(
  given: Mesh,
  { regions, isNested, position, volume, depth }: SharedVolume,
  isLeft: (region: number) => boolean,
): Diagnostic {
  if (isNested) return innerSolid(given.surfaceRegions, { regions, position });
  const [one, two] = regions.map((region) => solidOf(given, region).volume);
  const share = volume / Math.min(one ?? 0, two ?? 0);
  const overlap = { regions, position, volume, share };
  return isLeft(regions[1])
    ? assignedOverlap(given.surfaceRegions, overlap, depth)
    : overlapWarning(given.surfaceRegions, overlap, { isLeft, into: regions[0] });
}

/** Returns the overlaps of the solids of a shared volume that are not known yet. */
function overlapsIn(
  given: Mesh,
  { regions, volume, position }: CommonVolume,
  known: readonly Overlap[],
): Overlap[] {
  const [first = 0, ...others] = regions;
  return others.flatMap((other): Overlap[] => {
    const pair = first < other ? ([first, other] as const) : ([other, first] as const);
    if (known.some((one) => one.regions.join() === pair.join())) return [];
    const [one, two] = pair.map((region) => solidOf(given, region).volume);
    const smaller = Math.min(one ?? 0, two ?? 0);
    // Solids that a repair has joined share less than the volume of both.
    return volume < smaller ? [{ regions: pair, position, volume, share: volume / smaller }] : [];
  });
}

const JOINED_REMEDY =
  'Use `surface: "remesh"`, which cuts them where they touch; or divide their faces there in the CAD program.';

/** As `withSolidRegions` for a surface that is not repaired. Rejects with `invalid-input`, which names the solids that intersect. */
export async function checkedSolids(
  mesher: SurfaceMesher,
  given: Mesh,
  innerShells: InnerShells | undefined,
): Promise<Solids> {
  const { isFillable, diagnostics } = await mesher.inspectSurface(withoutRegions(given), { innerShells });
  if (isFillable) return withSolidRegions(mesher, given, given);
  const touching = touchingSolids(given.surfaceRegions, diagnostics, JOINED_REMEDY);
  const others = diagnostics.filter(
    ({ code }) => code !== "self-intersection" && code !== "duplicate-triangle",
  );
  if (touching.length > 0) refuse([...touching, ...others.filter(({ severity }) => severity === "error")]);
  return { surface: given, warnings: [] };
}

/** Returns a note on which of the solids of a surface share faces; nothing if one at most is left. */
export function sharedFacesNote({ surfaceRegions }: Mesh): Diagnostic[] {
  if (surfaceRegions === undefined) return [];
  const { regions, triangleRegions } = surfaceRegions;
  const left = new Set(triangleRegions);
  left.delete(NO_REGION);
  if (left.size < 2) return [];
  const pairs = new Set<string>();
  for (let side = 0; side < triangleRegions.length; side += 2) {
    const [one = NO_REGION, other = NO_REGION] = triangleRegions.subarray(side, side + 2);
    if (one === NO_REGION || other === NO_REGION) continue;
    pairs.add([one, other].sort((a, b) => a - b).join(" "));
  }
  const names = [...pairs].map((pair) =>
    pair
      .split(" ")
      .map((region) => `"${regions[Number(region)]?.name ?? ""}"`)
      .join(" and "),
  );
  const [first = "", ...more] = names;
  const listed = more.length > MAX_PAIRS ? `${first} and ${more.length} more pairs` : names.join("; ");
  const what = names.length === 0 ? "none of them share faces" : `shared faces: ${listed}`;
  return [packageDiagnostic("touching-solids", `${left.size} solids; ${what}`, "", "information")];
}

/** Largest number of pairs that are listed, after the first. */
const MAX_PAIRS = 9;
