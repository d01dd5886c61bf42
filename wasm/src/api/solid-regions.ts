/** Which solid each enclosed volume of a surface of several solids belongs to, also after a repair of the surface. */
import type { SurfaceMesher } from "./surface-mesher.js";
import { centroidOf, cornersOf, dot, lengthOf, normalOf, type Vector } from "../base/vectors.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { diagonalOf } from "../formats/near-points.js";
import { sixfoldVolume } from "../formats/sixfold-volume.js";
import { NO_ORIGIN, NO_REGION } from "../generated/constants.js";
import { short } from "../base/short.js";
import type { Mesh } from "../mesh/mesh.js";

/** Number of significant digits of volumes. */
const DIGITS = 3;

/** An enclosed volume. */
interface Cell {
  volume: number;
  area: number;
  /** Centroid of one of its triangles. */
  position: Vector;
  /** Per solid: area of its triangles that have the cell inside. */
  readonly inside: Map<number, number>;
  /** Solids whose triangles have the cell outside. */
  readonly beside: Set<number>;
}

export interface SolidRegions {
  readonly surface: Mesh;
  /** Notes about closed gaps between solids, which stay empty. */
  readonly gaps: readonly Diagnostic[];
  /** Volumes inside several solids. */
  readonly shared: readonly CommonVolume[];
}

export interface CommonVolume {
  /** Indices of the solids, that of the one that gets the volume first. */
  readonly regions: readonly number[];
  readonly volume: number;
  readonly position: Vector;
}

/**
 * Assigns each volume that `made` encloses to the solid that has it inside, and leaves volumes outside of all solids empty. A
 * volume inside several solids goes to the one with most area around it. `made`: the given surface, or the result of its
 * repair, with the indices of the given triangles; it must be fillable. `isAssigned`: whether the repair assigned the volumes.
 */
export async function solidRegions(
  mesher: SurfaceMesher,
  given: Mesh,
  made: Mesh,
  isAssigned: boolean,
): Promise<SolidRegions> {
  const { regionPoints: _, surfaceRegions: __, origin: ___, ...plain } = made;
  const { mesh: located } = await mesher.locateRegions(plain);
  const cellOf = located.surfaceRegions?.triangleRegions ?? new Uint32Array();
  const origins = Uint32Array.from(located.origin ?? [], (t) =>
    made === given ? t : (made.origin?.[t] ?? NO_ORIGIN),
  );
  const cells = cellsOf(given, located, { cellOf, origins });
  const assigned = isAssigned ? assignedRegions(made, located, cellOf) : undefined;
  const regionOf = assigned ?? cells.map(({ inside }) => winnerOf(inside));
  const triangleRegions = cellOf.map((cell) => regionOf[cell] ?? NO_REGION);
  const shared = isAssigned
    ? []
    : cells.flatMap(({ inside, volume, position }, c) => {
        const first = regionOf[c] ?? NO_REGION;
        const others = [...inside.keys()].filter((region) => region !== first);
        return others.length === 0 ? [] : [{ regions: [first, ...others], volume, position }];
      });
  const smallest = SMALLEST_GAP * diagonalOf(given.points);
  const gaps = cells.filter((cell) => widthOf(cell) > smallest).flatMap((cell) => gapNote(given, cell));
  const { regions = [], maxVolumes } = given.surfaceRegions ?? {};
  const whole: Mesh = {
    ...located,
    origin: origins,
    surfaceRegions: { regions, triangleRegions, areMeshed: true, ...(maxVolumes && { maxVolumes }) },
  };
  return { surface: withoutInnerTriangles(whole), gaps, shared };
}

/** Returns the region of each volume, as the sides of the triangles state it. */
function assignedRegions(made: Mesh, located: Mesh, cellOf: Uint32Array): number[] {
  const sides = made.surfaceRegions?.triangleRegions ?? new Uint32Array();
  const regionOf: number[] = [];
  (located.origin ?? []).forEach((from, t) => {
    for (const k of [0, 1]) {
      const cell = cellOf[2 * t + k] ?? NO_REGION;
      if (cell !== NO_REGION) regionOf[cell] = sides[2 * from + k] ?? NO_REGION;
    }
  });
  return regionOf;
}

interface Sides {
  /** Two per triangle: the volume behind it and that in front. */
  readonly cellOf: Uint32Array;
  /** Per triangle: that of the given surface of which it is a part. */
  readonly origins: Uint32Array;
}

function cellsOf(given: Mesh, located: Mesh, { cellOf, origins }: Sides): Cell[] {
  const count = cellOf.reduce((most, cell) => (cell === NO_REGION ? most : Math.max(most, cell + 1)), 0);
  const cells = Array.from({ length: count }, (): Cell => ({
    volume: 0,
    area: 0,
    position: [0, 0, 0],
    inside: new Map(),
    beside: new Set(),
  }));
  const sides = given.surfaceRegions?.triangleRegions ?? new Uint32Array();
  for (let t = 0; t < origins.length; t++) {
    const [a = 0, b = 0, c = 0] = located.triangles.subarray(3 * t, 3 * t + 3);
    const sixfold = sixfoldVolume(located.points, 0, a, b, c).volume;
    const corners = cornersOf(located, t);
    const normal = normalOf(corners);
    const area = lengthOf(normal) / 2;
    const from = origins[t] ?? NO_ORIGIN;
    const isFlipped = from !== NO_ORIGIN && dot(normal, normalOf(cornersOf(given, from))) < 0;
    for (const k of [0, 1]) {
      const cell = cells[cellOf[2 * t + k] ?? NO_REGION];
      if (cell === undefined) continue;
      cell.volume += ((k === 0 ? 1 : -1) * sixfold) / 6;
      if (cell.area === 0) cell.position = centroidOf(corners);
      cell.area += area;
      if (from === NO_ORIGIN) continue;
      const [own = NO_REGION, other = NO_REGION] = [0, 1].map(
        (s) => sides[2 * from + (isFlipped ? 1 - s : s)],
      );
      const [region, beyond] = k === 0 ? [own, other] : [other, own];
      if (region !== NO_REGION) cell.inside.set(region, (cell.inside.get(region) ?? 0) + area);
      else if (beyond !== NO_REGION) cell.beside.add(beyond);
    }
  }
  return cells;
}

/** Returns the solid with the largest area around a volume, the first of equal ones; `NO_REGION` without any. */
function winnerOf(inside: ReadonlyMap<number, number>): number {
  return [...inside].reduce(
    (best, [region, area]) =>
      area > best.area || (area === best.area && region < best.region) ? { region, area } : best,
    { region: NO_REGION, area: 0 },
  ).region;
}

/** Width of a gap / diagonal up to which it is due to rounding. */
const SMALLEST_GAP = 1e-6;

/** Returns the mean width of a thin volume. */
const widthOf = ({ volume, area }: Cell): number => (2 * volume) / area;

/** Two solids that enclose a volume outside of both have a gap between them. A solid alone has a cavity. */
function gapNote({ surfaceRegions }: Mesh, cell: Cell): Diagnostic[] {
  const { inside, beside, volume, position } = cell;
  if (inside.size > 0 || beside.size < 2) return [];
  const names = [...beside].sort((a, b) => a - b).map((r) => `"${surfaceRegions?.regions[r]?.name ?? ""}"`);
  const width = short(widthOf(cell), DIGITS);
  const message = `Between the solids ${names.join(", ")} is a closed gap with a volume of ${short(volume, DIGITS)}, about ${width} wide. It stays empty`;
  const remedy = "If they are meant to touch there, give both the same face.";
  return [{ ...packageDiagnostic("touching-solids", message, remedy, "information"), position }];
}

/** Leaves out triangles with the same region on both sides. */
function withoutInnerTriangles(surface: Mesh): Mesh {
  const { triangles, trianglePatch, origin, surfaceRegions } = surface;
  const sides = surfaceRegions?.triangleRegions ?? new Uint32Array();
  const kept = [...trianglePatch.keys()].filter((t) => sides[2 * t] !== sides[2 * t + 1]);
  if (kept.length === trianglePatch.length) return surface;
  const pick = (values: Uint32Array, width: number) =>
    Uint32Array.from(kept.flatMap((t) => [...values.subarray(width * t, width * (t + 1))]));
  const triangleRegions = pick(sides, 2);
  return {
    ...surface,
    triangles: pick(triangles, 3),
    trianglePatch: pick(trianglePatch, 1),
    ...(origin && { origin: pick(origin, 1) }),
    ...(surfaceRegions && { surfaceRegions: { ...surfaceRegions, triangleRegions } }),
  };
}
