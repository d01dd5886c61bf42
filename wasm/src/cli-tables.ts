/** Figures in lines of text, for people. */
import type { FileMesh } from "./formats/file-mesh.js";
import type { EdgeLengths, MeshInspection, SurfaceInspection } from "./inspection.js";
import { plural } from "./plural.js";
import type { QualityReport } from "./types.js";

/** Enough to read. */
const DIGITS = 6;
/** That tell any two doubles apart. */
const MOST_DIGITS = 17;

export function short(value: number, digits = DIGITS): string {
  return String(Number(value.toPrecision(digits)));
}

export function placeText(place: readonly number[]): string {
  return `(${place.map((value) => short(value)).join(", ")})`;
}

/** "box (0, 0, 0) to (1, 1, 1)", with as many digits as show six of each side, however far from the origin it is. */
export function boxText({ low, high }: Box): string {
  const digits = low.map((from, axis) => {
    const to = high[axis] ?? from;
    const beyond = Math.floor(Math.log10(Math.max(Math.abs(from), Math.abs(to)) / (to - from)));
    return to > from ? Math.min(MOST_DIGITS, DIGITS + Math.max(0, beyond)) : DIGITS;
  });
  const [from, to] = [low, high].map((corner) => corner.map((value, axis) => short(value, digits[axis])));
  return `box (${from?.join(", ")}) to (${to?.join(", ")})`;
}

interface Box {
  readonly low: readonly number[];
  readonly high: readonly number[];
}

/** A line where a file counts the nodes of some tetrahedra one way round and of others the other. */
export function mixedTurns({ tetrahedra, turnedTetrahedra = 0 }: FileMesh): string[] {
  const count = tetrahedra.length / 4;
  if (turnedTetrahedra === 0 || turnedTetrahedra === count) return [];
  return [`turned, as inverted against the others: ${turnedTetrahedra} of ${plural(count, "tetrahedron")}`];
}

/** That elements lose all groups but their first. */
export function repeatedLines({
  repeatedTetrahedra = 0,
  repeatedTriangles = 0,
}: Pick<FileMesh, "repeatedTetrahedra" | "repeatedTriangles">): string[] {
  const lines = (count: number, noun: string) =>
    count === 0
      ? []
      : [`${plural(count, "further entry")} of ${noun} that are there before: the first counts`];
  return [...lines(repeatedTetrahedra, "tetrahedra"), ...lines(repeatedTriangles, "triangles")];
}

/** That names of regions come to nothing. */
export function unplacedLines({ unplacedRegions = [] }: Pick<FileMesh, "unplacedRegions">): string[] {
  if (unplacedRegions.length === 0) return [];
  const names = unplacedRegions.map((name) => `"${name}"`).join(", ");
  return [`the file names ${names} and does not tell which space is which: regions are numbered`];
}

/** That spaces to which the file gives names are not filled. */
export function leftOutLines(
  { surfaceRegions }: Pick<FileMesh, "surfaceRegions">,
  { regions }: Pick<FileMesh, "regions">,
): string[] {
  const leftOut = (surfaceRegions?.regions ?? []).filter(({ tag }) =>
    regions.every((one) => one.tag !== tag),
  );
  if (leftOut.length === 0) return [];
  const names = leftOut.map(({ name }) => `"${name}"`).join(", ");
  return [`not filled of the file's regions: ${names}. --enclosed regions fills bodies within a body, too`];
}

export function surfaceLines(found: Omit<SurfaceInspection, "diagnostics">): string[] {
  if (found.box === null) return [];
  const isKnown = found.isFillable;
  return [
    `${plural(found.triangles, "triangle")}, ${plural(found.nodes, "node")}, ${plural(found.edges, "edge")}`,
    [
      found.isClosed ? "closed" : `not closed (${plural(found.openEdges, "open edge")})`,
      found.isManifold ? "manifold" : `not manifold (${notManifold(found)})`,
      found.isEmbedded ? "free of crossings" : "cuts itself",
    ].join(", "),
    ...(isKnown ? [`${plural(found.bodies, "body")}, ${plural(found.cavities, "cavity")}`] : []),
    `area ${short(found.area)}${isKnown ? `, volume ${short(found.volume)}` : ""}`,
    boxText(found.box),
    edgesLine(found.edgeLengths),
    ...(found.turnedTriangles > 0
      ? [
          `${plural(found.turnedTriangles, "triangle")} not turned outward${isKnown ? ", as whole parts" : ""}`,
        ]
      : []),
    ...found.worst
      .slice(0, 3)
      .map(
        ({ triangle, smallestAngle, radiusRatio, place }) =>
          `among the worst: triangle ${triangle}, smallest angle ${smallestAngle.toFixed(2)}°, radius ratio ${radiusRatio.toFixed(3)}, at ${placeText(place)}`,
      ),
  ];
}

function notManifold({ crowdedEdges, pinchedNodes }: Omit<SurfaceInspection, "diagnostics">): string {
  const parts = [
    ...(crowdedEdges > 0 ? [`${plural(crowdedEdges, "edge")} of more than two triangles`] : []),
    ...(pinchedNodes > 0 ? [`${plural(pinchedNodes, "node")} where it touches itself`] : []),
  ];
  return parts.join(", ");
}

export function meshLines(found: Omit<MeshInspection, "boundary" | "quality">): string[] {
  const { dihedral, radiusRatio } = found;
  return [
    `${plural(found.tetrahedra, "tetrahedron")}, ${plural(found.nodes, "node")}`,
    `volume ${short(found.volume)}`,
    edgesLine(found.edgeLengths),
    `dihedral angles ${dihedral.min.toFixed(2)}° to ${dihedral.max.toFixed(2)}°`,
    `radius ratio ${radiusRatio.min.toFixed(3)}, in the mean ${radiusRatio.mean.toFixed(3)}`,
  ];
}

function edgesLine({ shortest, mean, longest }: EdgeLengths): string {
  return `edges ${short(shortest)} to ${short(longest)}, in the mean ${short(mean)}`;
}

const BAR_WIDTH = 40;

/** The distribution of all dihedral angles, and the worst elements. */
export function qualityLines({ regions, worst, binWidths }: QualityReport): string[] {
  const bins = regions.reduce<number[]>(
    (sum, { dihedral }) => dihedral.map((count, i) => count + (sum[i] ?? 0)),
    [],
  );
  const most = Math.max(1, ...bins);
  const bars = bins.flatMap((count, i) => {
    if (count === 0) return [];
    const from = i * binWidths.dihedral;
    const range = `${from}° to ${from + binWidths.dihedral}°`.padStart(12);
    return [`${range} ${"#".repeat(Math.ceil((BAR_WIDTH * count) / most))} ${count}`];
  });
  return [
    "dihedral angles:",
    ...bars,
    ...worst
      .slice(0, 5)
      .map(
        ({ tetrahedron, dihedral, place }) =>
          `among the worst: tetrahedron ${tetrahedron}, ${dihedral.min.toFixed(2)}° to ${dihedral.max.toFixed(2)}°, at ${placeText(place)}`,
      ),
  ];
}
