/** Names the solids whose triangles intersect, where a surface consists of several. */
import { inSteps } from "../calls/yielder.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { componentsOf } from "../formats/components.js";
import { NO_REGION, type InnerShells } from "../generated/constants.js";
import type { Mesh, SurfaceRegions } from "../mesh/mesh.js";
import type { SurfaceMesher } from "./surface-mesher.js";

/** Two solids with intersecting triangles: indices of their regions, the smaller first. */
export interface TouchingPair {
  readonly regions: readonly [number, number];
  /** Where two of the triangles intersect. */
  readonly position: Diagnostic["position"];
}

/**
 * Returns the pairs of solids whose triangles intersect, according to the diagnostics of an inspection. `given`: the
 * regions of the surface whose triangles the diagnostics number, which is the one before a repair.
 */
export function touchingPairs(
  given: SurfaceRegions | undefined,
  diagnostics: readonly Diagnostic[],
): TouchingPair[] {
  if (given === undefined) return [];
  const { triangleRegions } = given;
  const pairs = new Map<string, TouchingPair>();
  for (const { code, entities, position } of diagnostics) {
    if (code !== "self-intersection" && code !== "duplicate-triangle") continue;
    const [one = [], other = []] = entities
      .filter(({ kind }) => kind === "triangle")
      // The index of a triangle of a filled hole is not one of the given surface.
      .map(({ index, label }) => (label.startsWith("filled") ? [] : sidesOf(triangleRegions, index)));
    const [first, second] = [one[0], other[0]];
    if (first === undefined || second === undefined || one.some((region) => other.includes(region))) continue;
    const regions = first < second ? ([first, second] as const) : ([second, first] as const);
    const key = regions.join(" ");
    if (!pairs.has(key)) pairs.set(key, { regions, position });
  }
  return [...pairs.values()];
}

/**
 * Returns a surface with a region per solid if it states none, but its patches are closed by themselves, as the solids of an STL
 * file. Else returns the given surface.
 */
export async function withSolidsOfPatches(given: Mesh): Promise<Mesh> {
  if (given.patches.length < 2) return given;
  const { solidsOfPatches } = await import("../formats/patch-solids.js");
  return (await inSteps(solidsOfPatches(given))) ?? given;
}

/** As `withSolidsOfPatches`, if solids touch or intersect. */
export async function withTouchingSolids(
  mesher: Pick<SurfaceMesher, "inspectSurface">,
  given: Mesh,
  innerShells: InnerShells | undefined,
): Promise<Mesh> {
  const solids = await withSolidsOfPatches(given);
  if (solids === given) return given;
  const { diagnostics } = await mesher.inspectSurface(given, { innerShells });
  const areTouching = diagnostics.some(
    ({ code, entities }) =>
      (code === "self-intersection" || code === "duplicate-triangle") &&
      new Set(entities.map(({ index }) => given.trianglePatch[index])).size > 1,
  );
  return areTouching ? solids : given;
}

/**
 * Returns the number of pairs of closed shells that touch or intersect, if nothing else is wrong with a surface without solids.
 * Shells that intersect themselves need a repair that is asked for.
 */
export async function touchingShells(
  mesher: Pick<SurfaceMesher, "inspectSurface">,
  given: Mesh,
  innerShells: InnerShells | undefined,
): Promise<number> {
  const shells = componentsOf(given.triangles, given.points.length / 3);
  if (shells.every((shell) => shell === shells[0])) return 0;
  const { openEdges, diagnostics } = await mesher.inspectSurface(given, { innerShells });
  if (openEdges > 0) return 0;
  const pairs = new Set<string>();
  for (const { code, severity, entities } of diagnostics) {
    if (severity !== "error") continue;
    const [one, other] = entities.map(({ index }) => shells[index] ?? 0);
    if (code !== "self-intersection" || one === undefined || other === undefined || one === other) return 0;
    pairs.add([one, other].sort((a, b) => a - b).join(" "));
  }
  return pairs.size;
}

function sidesOf(triangleRegions: Uint32Array, triangle: number): number[] {
  return [...triangleRegions.subarray(2 * triangle, 2 * triangle + 2)].filter(
    (region) => region !== NO_REGION,
  );
}

const IMPRINT =
  "Divide the faces where the solids touch (an imprint or fragment operation of the CAD program), or mesh the solids one by one.";

/**
 * Returns one error per pair of solids whose triangles intersect. `given` and `diagnostics` are those of `touchingPairs`;
 * `remedy` is what to do, if there is more than to divide the faces.
 */
export function touchingSolids(
  given: SurfaceRegions | undefined,
  diagnostics: readonly Diagnostic[],
  remedy = IMPRINT,
): Diagnostic[] {
  return touchingPairs(given, diagnostics).map(({ regions, position }) => {
    const message = `The solids ${namesOf(given, regions)} overlap, or touch in faces with different boundaries`;
    return { ...packageDiagnostic("touching-solids", message, remedy), ...(position && { position }) };
  });
}

/** A volume that two solids share. */
export interface Overlap extends TouchingPair {
  readonly volume: number;
  /** `volume` / volume of the smaller solid. */
  readonly share: number;
}

/** What became of solids that overlap. */
export interface OverlapOutcome {
  /** Whether a solid has a region in the surface that will be meshed. */
  readonly isLeft: (region: number) => boolean;
  /** The solid whose region got the volume. */
  readonly into: number | undefined;
}

/** Returns a warning that two solids share a volume. `outcome`: undefined if it is not known. */
export function overlapWarning(
  given: SurfaceRegions | undefined,
  { regions, position, volume, share }: Overlap,
  outcome?: OverlapOutcome,
): Diagnostic {
  const size = sizeText(volume, share);
  return overlapping(
    `The solids ${namesOf(given, regions)} overlap by a volume of ${size}${outcomeText(given, regions, outcome)}`,
    position,
  );
}

/** Smallest common volume, relative to the smaller solid: curved faces that touch overlap by their deviation. */
export const SMALLEST_OVERLAP = 1e-3;

/**
 * Says that the first of two solids got the volume that they shared, and that both kept their regions. `depth`: mean width of
 * the volume. A warning if the volume is too large to be due to the triangulation of faces that touch.
 */
export function assignedOverlap(
  given: SurfaceRegions | undefined,
  { regions, position, volume, share }: Overlap,
  depth: number,
): Diagnostic {
  const names = namesOf(given, regions);
  const size = `${sizeText(volume, share)}, about ${Number(depth.toPrecision(3))} deep`;
  const message = `The solids ${names} overlap by a volume of ${size}. It became a part of ${namesOf(given, regions.slice(0, 1))}; both kept their regions`;
  const remedy = "If they are meant to touch, subtract one from the other, or move them apart.";
  const severity = share < SMALLEST_OVERLAP ? "information" : "warning";
  return {
    ...packageDiagnostic("touching-solids", message, remedy, severity),
    ...(position && { position }),
  };
}

/** Says that the first of two solids lies wholly inside the second one. */
export function innerSolid(
  given: SurfaceRegions | undefined,
  { regions, position }: TouchingPair,
): Diagnostic {
  const [inner, outer] = regions.map((region) => namesOf(given, [region]));
  const message = `The solid ${inner} lies inside ${outer}. Both are regions; ${outer} is the rest around it`;
  return {
    ...packageDiagnostic("touching-solids", message, "", "information"),
    ...(position && { position }),
  };
}

function sizeText(volume: number, share: number): string {
  const percent = 100 * share < 0.1 ? "less than 0.1" : String(Number((100 * share).toPrecision(2)));
  return `${Number(volume.toPrecision(3))}, ${percent} % of the smaller one`;
}

/** Returns a warning that solids became one region, because they intersect. */
export function mergeWarning(
  given: SurfaceRegions | undefined,
  regions: readonly number[],
  position: Diagnostic["position"],
): Diagnostic {
  const message = `The solids ${namesOf(given, regions)} intersect. They became one region, ${namesOf(given, regions.slice(0, 1))}`;
  return overlapping(message, position);
}

function overlapping(message: string, position: Diagnostic["position"]): Diagnostic {
  const remedy =
    "To keep both as regions, subtract one from the other, or move them apart, before they are joined.";
  return {
    ...packageDiagnostic("touching-solids", message, remedy, "warning"),
    ...(position && { position }),
  };
}

function outcomeText(
  given: SurfaceRegions | undefined,
  regions: readonly number[],
  outcome: OverlapOutcome | undefined,
): string {
  if (outcome === undefined) return "";
  const { isLeft, into } = outcome;
  if (regions.every(isLeft)) return ". It counts once, as a part of one of them";
  const left = into === undefined ? regions.filter(isLeft) : [into];
  const name = left.length === 0 ? "" : `, ${namesOf(given, left)}`;
  return `. They became one region${name}`;
}

function namesOf(given: SurfaceRegions | undefined, regions: readonly number[]): string {
  return regions.map((region) => `"${given?.regions[region]?.name ?? ""}"`).join(" and ");
}
