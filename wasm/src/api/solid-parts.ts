/** The solids of an STL file that are prepared by themselves, because others of the file touch; and what became of all of them. */
import { nearPairs } from "../base/boxes.js";
import { connectedGroups } from "../base/connected-groups.js";
import { inSteps } from "../calls/yielder.js";
import { solidsOfPatches } from "../formats/patch-solids.js";
import {
  boxOf,
  partOfSolids,
  solidUnits,
  type SolidsSurface,
  unitedSurfaces,
} from "../formats/solid-units.js";
import type { ChangedSurface, RefinementCounts, RemeshReport } from "./meshed-surface.js";
import { withSolidRegions } from "./solids.js";
import { withoutRegions } from "./stated-solids.js";
import type { SurfaceMesher } from "./surface-mesher.js";
import type { TreatedSurface } from "./surface-treatment.js";
import { chainedOrigins } from "./surface-numbers.js";
import { changeInWhole, inWhole, type WholeNumbers, withWholeOrigins } from "./whole-numbers.js";
import type { Mesh } from "../mesh/mesh.js";

/** Solids that are prepared together. */
export interface SolidPart {
  readonly surface: Mesh;
  readonly numbers: WholeNumbers;
}

/**
 * Returns the surfaces of solids that are prepared together, by their first solids; undefined if all are, or if the file states
 * other solids. Solids that touch are one surface, with their regions; those that may touch, but do not, one each; all others
 * one together. O(n log n) per pair of solids whose boxes are not apart.
 */
export async function solidParts(
  mesher: SurfaceMesher,
  given: Mesh,
): Promise<readonly SolidPart[] | undefined> {
  const divided = await inSteps(solidsOfPatches(given));
  if (divided?.surfaceRegions === undefined) return undefined;
  const solids: SolidsSurface = { ...divided, surfaceRegions: divided.surfaceRegions };
  const units = solidUnits(solids);
  if (units.length < 2) return undefined;
  const surfaces = units.map((unit) => withoutRegions(partOfSolids(solids, unit)));
  for (const surface of surfaces) if (!(await isFillable(mesher, [surface]))) return undefined;
  const touching: (readonly [number, number])[] = [];
  for (const pair of nearPairs(surfaces.map(({ points }) => boxOf(points)))) {
    const two = pair.flatMap((unit) => surfaces[unit] ?? []);
    if (!(await isFillable(mesher, two))) touching.push(pair);
  }
  const groups = connectedGroups(units.length, touching);
  if (groups.length < 2) return undefined;
  const parts: SolidPart[] = [];
  for (const group of groups) {
    const own = group.flatMap((unit) => units[unit] ?? []).sort((a, b) => a - b);
    const { wholeTriangles, wholeNodes, ...surface } = partOfSolids(solids, own);
    const numbers = {
      wholeTriangles: chainedOrigins(given.origin, wholeTriangles),
      wholeNodes: chainedOrigins(given.nodeOrigin, wholeNodes),
    };
    // Before their treatment, they do not state what is filled.
    const nested = group.length > 1 ? surface : withoutRegions(await withNesting(mesher, surface));
    parts.push({ surface: nested, numbers });
  }
  return parts;
}

/** Returns solids whose triangles do not intersect with the regions on both sides of each: one may lie within another. */
export async function withNesting(mesher: SurfaceMesher, part: Mesh): Promise<Mesh> {
  if ((part.surfaceRegions?.regions.length ?? 0) < 2) return part;
  const { surfaceRegions } = (await withSolidRegions(mesher, part, part)).surface;
  return { ...part, ...(surfaceRegions && { surfaceRegions }) };
}

async function isFillable(mesher: SurfaceMesher, surfaces: readonly Mesh[]): Promise<boolean> {
  const [first] = surfaces;
  const surface = surfaces.length === 1 && first !== undefined ? first : unitedSurfaces(surfaces);
  return (await mesher.inspectSurface(surface)).isFillable;
}

/** Returns surfaces that are ready as one; it names triangles and nodes by their numbers in the whole surface. */
export function unitedReady(
  parts: readonly (ChangedSurface & { readonly numbers: WholeNumbers })[],
): ChangedSurface {
  const changes = parts.flatMap(({ numbers, changes: own = [] }) =>
    own.map((one) => changeInWhole(numbers, one)),
  );
  const deviations = parts.flatMap(({ repairDeviation }) => repairDeviation ?? []);
  return {
    surface: unitedSurfaces(parts.map(({ numbers, surface }) => withWholeOrigins(numbers, surface))),
    ...(parts.some((one) => one.changes !== undefined) && {
      changes,
      repairDeviation: Math.max(0, ...deviations),
    }),
    diagnostics: parts.flatMap(({ numbers, diagnostics }) => diagnostics.map((one) => inWhole(numbers, one))),
  };
}

/** What became of a part, in its own numbers. */
export interface TreatedPart extends TreatedSurface {
  readonly numbers: WholeNumbers;
}

/**
 * Returns what became of several surfaces as one: counts are sums, and shapes and distances the worst. It names triangles and
 * nodes by their numbers in the whole surface.
 */
export function unitedTreated(parts: readonly TreatedPart[]): TreatedSurface {
  const all = parts.map(({ numbers, ...one }): TreatedSurface => ({
    ...one,
    surface: withWholeOrigins(numbers, one.surface),
    ...(one.invalid && { invalid: one.invalid.map((found) => inWhole(numbers, found)) }),
    ...(one.diagnostics && { diagnostics: one.diagnostics.map((found) => inWhole(numbers, found)) }),
  }));
  const invalid = all.flatMap((one) => one.invalid ?? []);
  const diagnostics = all.flatMap((one) => one.diagnostics ?? []);
  const refinement = unitedRefinements(all.flatMap((one) => one.refinement ?? []));
  const remesh = unitedRemeshes(all.flatMap((one) => one.remesh ?? []));
  return {
    surface: unitedSurfaces(all.map(({ surface }) => surface)),
    ...(refinement && { refinement }),
    ...(remesh && { remesh }),
    ...(invalid.length > 0 && { invalid }),
    diagnostics: diagnostics.filter(
      ({ code, message }, d) =>
        diagnostics.findIndex((one) => one.code === code && one.message === message) === d,
    ),
  };
}

const sumOf = (numbers: readonly number[]): number => numbers.reduce((sum, number) => sum + number, 0);

function unitedRefinements(all: readonly RefinementCounts[]): RefinementCounts | undefined {
  if (all.length === 0) return undefined;
  return {
    given: sumOf(all.map(({ given }) => given)),
    triangles: sumOf(all.map(({ triangles }) => triangles)),
    splitEdges: sumOf(all.map(({ splitEdges }) => splitEdges)),
    lengthRatio: Math.max(...all.map(({ lengthRatio }) => lengthRatio)),
  };
}

function unitedRemeshes(all: readonly RemeshReport[]): RemeshReport | undefined {
  const [first] = all;
  if (first === undefined) return undefined;
  const triangles = sumOf(all.map((one) => one.triangles));
  return {
    ...first,
    given: sumOf(all.map(({ given }) => given)),
    triangles,
    patches: sumOf(all.map(({ patches }) => patches)),
    featureLines: sumOf(all.map(({ featureLines }) => featureLines)),
    size: Math.max(...all.map(({ size }) => size)),
    minSize: Math.min(...all.map(({ minSize }) => minSize)),
    tolerance: Math.max(...all.map(({ tolerance }) => tolerance)),
    deviation: Math.max(...all.map(({ deviation }) => deviation)),
    smallestAngle: Math.min(...all.map(({ smallestAngle }) => smallestAngle)),
    meanRadiusRatio: sumOf(all.map((one) => one.meanRadiusRatio * one.triangles)) / Math.max(triangles, 1),
    givenVolume: sumOf(all.map(({ givenVolume }) => givenVolume)),
    volume: sumOf(all.map(({ volume }) => volume)),
    mergedDetails: all.flatMap(({ mergedDetails }) => mergedDetails),
    onFaces: all.every(({ onFaces }) => onFaces),
    failedFaces: all.flatMap(({ failedFaces }) => failedFaces),
    isPartial: all.some(({ isPartial }) => isPartial),
  };
}
