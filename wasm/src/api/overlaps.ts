/** Finds solids of a surface whose volumes overlap, and bodies that a repair has joined. */
import type { SurfaceMesher } from "./surface-mesher.js";
import { type Overlap, SMALLEST_OVERLAP, type TouchingPair } from "./touching-solids.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { componentsOf, disjointSets } from "../formats/components.js";
import { sixfoldVolume } from "../formats/sixfold-volume.js";
import type { Mesh, SurfaceInput } from "../mesh/mesh.js";
import { short } from "../base/short.js";

/** Significant digits of a volume. */
const DIGITS = 3;

/** The whole surface after its repair. */
export interface Whole {
  readonly isFillable: boolean;
  readonly volume: number;
}

/**
 * Returns those of the pairs of solids that share a volume. `whole`: inspection of the
 * surface after its repair. If it encloses as much as all solids one by one, no pair is looked at; and of the others, only
 * those with boxes that share a volume, each with its own triangles alone.
 */
export async function overlappingSolids(
  mesher: SurfaceMesher,
  given: Mesh,
  pairs: readonly TouchingPair[],
  whole: Whole,
): Promise<Overlap[]> {
  const { surfaceRegions } = given;
  if (surfaceRegions === undefined || pairs.length === 0) return [];
  const solids = surfaceRegions.regions.map((_, region) => solidOf(given, region));
  const total = solids.reduce((sum, { volume }) => sum + volume, 0);
  const smallest = smallestOf(solids.map(({ volume }) => volume));
  if (whole.isFillable && total - whole.volume <= SMALLEST_OVERLAP * smallest) return [];
  const overlaps: Overlap[] = [];
  for (const pair of pairs) overlaps.push(...(await overlapOf(mesher, given, pair, solids)));
  return overlaps;
}

/** Two solids share a volume if the repaired surface of both encloses less than they do one by one. */
async function overlapOf(
  mesher: SurfaceMesher,
  given: Mesh,
  pair: TouchingPair,
  solids: readonly Solid[],
): Promise<Overlap[]> {
  const { regions } = pair;
  const [one, other] = regions.map((region) => solids[region]);
  if (one === undefined || other === undefined) return [];
  const smaller = Math.min(one.volume, other.volume);
  const limit = SMALLEST_OVERLAP * smaller;
  if (commonBox(one, other) <= limit) return [];
  const { mesh: surface } = await mesher.repairSurface(partOf(given, new Set<number>(regions)));
  const { isFillable, volume } = await mesher.inspectSurface(surface);
  const common = one.volume + other.volume - volume;
  return isFillable && common > limit ? [{ ...pair, volume: common, share: common / smaller }] : [];
}

/** Returns the smallest number. There may be more of them than arguments of a function. */
const smallestOf = (numbers: readonly number[]): number =>
  numbers.reduce((least, one) => Math.min(least, one), Infinity);

export interface Solid {
  readonly volume: number;
  readonly low: readonly number[];
  readonly high: readonly number[];
}

/** Returns the volume of the box that two boxes share. */
function commonBox(one: Solid, other: Solid): number {
  return [0, 1, 2].reduce((volume, k) => {
    const low = Math.max(one.low[k] ?? 0, other.low[k] ?? 0);
    return volume * Math.max(0, Math.min(one.high[k] ?? 0, other.high[k] ?? 0) - low);
  }, 1);
}

/** Returns the triangles of some solids, with their own points. */
function partOf({ points, triangles, surfaceRegions }: Mesh, regions: ReadonlySet<number>): SurfaceInput {
  const sides = surfaceRegions?.triangleRegions ?? new Uint32Array();
  const corners: number[] = [];
  triangles.forEach((node, corner) => {
    const side = 2 * Math.floor(corner / 3);
    if (regions.has(sides[side] ?? -1) || regions.has(sides[side + 1] ?? -1)) corners.push(node);
  });
  return withOwnPoints(points, corners);
}

/** Returns the volume and the box of a solid, whose triangles face outward where it is on their first side. */
export function solidOf({ points, triangles, surfaceRegions }: Mesh, region: number): Solid {
  const sides = surfaceRegions?.triangleRegions ?? new Uint32Array();
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  let sixfold = 0;
  for (let t = 0; t < triangles.length / 3; t++) {
    const sign = Number(sides[2 * t] === region) - Number(sides[2 * t + 1] === region);
    if (sign === 0) continue;
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * t, 3 * t + 3);
    sixfold += sign * sixfoldVolume(points, 0, a, b, c).volume;
    for (const node of [a, b, c]) {
      for (let k = 0; k < 3; k++) {
        const x = points[3 * node + k] ?? 0;
        low[k] = Math.min(low[k] ?? x, x);
        high[k] = Math.max(high[k] ?? x, x);
      }
    }
  }
  return { volume: sixfold / 6, low, high };
}

/**
 * Returns a note if a repair has joined bodies that intersected. Bodies are the connected components of the given surface;
 * two of them are joined if they share a volume, which the repaired surface encloses once. `volume`: that of the latter. The
 * volume of a body with holes is that of its own repair, which closes them.
 */
export async function joinedBodies(
  mesher: SurfaceMesher,
  given: SurfaceInput,
  repaired: SurfaceInput,
  volume: number,
): Promise<Diagnostic[]> {
  const { origin } = repaired;
  if (origin === undefined) return [];
  const bodyOf = componentsOf(given.triangles, given.points.length / 3);
  const pieceOf = componentsOf(repaired.triangles, repaired.points.length / 3);
  // Joined bodies may have several pieces: their outside, and the cavities between them.
  const sets = disjointSets(given.points.length / 3);
  const bodyIn = new Map<number, number>();
  origin.forEach((from, t) => {
    const body = bodyOf[from];
    if (body === undefined) return;
    const piece = pieceOf[t] ?? 0;
    const other = bodyIn.get(piece);
    if (other === undefined) bodyIn.set(piece, body);
    else sets.join(other, body);
  });
  const groupOf = new Map<number, number[]>();
  for (const body of new Set(bodyOf)) {
    const root = sets.rootOf(body);
    groupOf.set(root, [...(groupOf.get(root) ?? []), body]);
  }
  const groups = [...groupOf.values()].filter(({ length }) => length > 1);
  if (groups.length === 0) return [];
  const volumes = new Map<number, number>();
  let open = 0;
  for (const [body, surface] of bodiesOf(given, bodyOf)) {
    const hasHoles = !isClosed(surface);
    // A soup of open pieces has no bodies to speak of.
    if (hasHoles && ++open > MAX_OPEN_BODIES) return [];
    volumes.set(body, await volumeOf(mesher, surface, hasHoles));
  }
  // A cavity counts as negative. Bodies that only touch keep their volumes, with an interface between them.
  const common = [...volumes.values()].reduce((sum, one) => sum + one, 0) - volume;
  const joined = groups.flat().map((body) => Math.abs(volumes.get(body) ?? 0));
  if (common <= SMALLEST_OVERLAP * smallestOf(joined)) return [];
  const message = `${plural(joined.length, "body")} that intersect became ${groups.length === 1 ? "one" : String(groups.length)}, without the parts inside; the volumes that they shared, ${short(common, DIGITS)} in all, count once`;
  const remedy = "Move the bodies apart, or subtract one from the other, to keep them as regions.";
  return [packageDiagnostic("joined-bodies", message, remedy, "information")];
}

/** Largest number of bodies with holes that are closed one by one to know their volumes. */
const MAX_OPEN_BODIES = 100;

/** Returns the triangles of each body, with their own points. */
function bodiesOf({ points, triangles }: SurfaceInput, bodyOf: Uint32Array): Map<number, SurfaceInput> {
  const corners = new Map<number, number[]>();
  bodyOf.forEach((body, t) => {
    const own = corners.get(body) ?? [];
    corners.set(body, own);
    own.push(...triangles.subarray(3 * t, 3 * t + 3));
  });
  return new Map([...corners].map(([body, own]) => [body, withOwnPoints(points, own)]));
}

/** Returns triangles with the points that they use. */
function withOwnPoints(points: Float64Array, corners: readonly number[]): SurfaceInput {
  const indexOf = new Map<number, number>();
  const used: number[] = [];
  const triangles = Uint32Array.from(corners, (node) => {
    const known = indexOf.get(node);
    if (known !== undefined) return known;
    used.push(points[3 * node] ?? 0, points[3 * node + 1] ?? 0, points[3 * node + 2] ?? 0);
    indexOf.set(node, indexOf.size);
    return indexOf.size - 1;
  });
  return { points: Float64Array.from(used), triangles };
}

/** Returns the volume of a body, negative if its triangles face inward; one with holes is closed first. */
async function volumeOf(mesher: SurfaceMesher, body: SurfaceInput, hasHoles: boolean): Promise<number> {
  if (hasHoles) {
    const { mesh: surface } = await mesher.repairSurface(body);
    const { isFillable, volume } = await mesher.inspectSurface(surface);
    if (isFillable) return volume;
  }
  const { points, triangles } = body;
  let sixfold = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a = 0, b = 0, c = 0] = triangles.subarray(t, t + 3);
    sixfold += sixfoldVolume(points, 0, a, b, c).volume;
  }
  return sixfold / 6;
}

/** Returns whether every edge of a surface goes as often one way as the other. O(n log n) for n triangles. */
function isClosed({ points, triangles }: SurfaceInput): boolean {
  const count = points.length / 3;
  // Twice a number of the edge, plus 1 for one of its directions.
  const edges = Float64Array.from(triangles, (from, corner) => {
    const to = triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? 0;
    return 2 * (Math.min(from, to) * count + Math.max(from, to)) + Number(from < to);
  }).sort();
  let balance = 0;
  for (const [i, edge] of edges.entries()) {
    balance += edge % 2 === 0 ? 1 : -1;
    const isLast = Math.floor((edges[i + 1] ?? Infinity) / 2) !== Math.floor(edge / 2);
    if (isLast && balance !== 0) return false;
  }
  return true;
}
