/** Figures in lines of text, for people. */
import type { FileMesh } from "../formats/file-mesh.js";
import type { EdgeLengths, MeshInspection, SurfaceInspection } from "../api/inspection.js";
import { listed } from "../formats/groups.js";
import { unusedData } from "../formats/volume-background.js";
import { plural } from "../base/plural.js";
import type { QualityReport } from "../api/types.js";

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

/** A line where a file counts the nodes of some tetrahedra the other way round than of the others. */
export function mixedTurns({ points, tetrahedra, invertedTetrahedra }: FileMesh): string[] {
  const count = invertedTetrahedra?.length ?? 0;
  if (invertedTetrahedra === undefined || count === 0) return [];
  const all = plural(tetrahedra.length / 4, "tetrahedron");
  const numbers = listed(Array.from(invertedTetrahedra, String));
  const node = 3 * (tetrahedra[4 * (invertedTetrahedra[0] ?? 0)] ?? 0);
  const place = placeText([...points.subarray(node, node + 3)]);
  return [
    `turned, as inverted against the others: ${count} of ${all}, ${numbers} (counted from 0), the first at ${place}`,
  ];
}

/** That a file counts all nodes the other way round than is usual, which is no fault. */
export function otherWay({ tetrahedra, turnedTetrahedra }: FileMesh): string[] {
  const isOtherWay = tetrahedra.length > 0 && turnedTetrahedra === tetrahedra.length / 4;
  return isOtherWay ? ["all tetrahedra have negative volumes in the file, and were turned"] : [];
}

/** What of a file is passed over. */
export function readingLines(
  mesh: Pick<FileMesh, "notes" | "repeatedTetrahedra" | "repeatedTriangles" | "unplacedRegions">,
): string[] {
  return [...repeatedLines(mesh), ...unplacedLines(mesh), ...(mesh.notes ?? [])];
}

/** That elements lose all groups but their first. */
function repeatedLines({
  repeatedTetrahedra = 0,
  repeatedTriangles = 0,
}: Pick<FileMesh, "repeatedTetrahedra" | "repeatedTriangles">): string[] {
  const lines = (count: number, noun: string) =>
    count === 0
      ? []
      : [`${plural(count, "further entry")} of ${noun} that are there before: the first counts`];
  return [...lines(repeatedTetrahedra, "tetrahedra"), ...lines(repeatedTriangles, "triangles")];
}

/** That numbers at the nodes of a background grid come to nothing. */
export function unusedLines(volume: Pick<FileMesh, "nodeData">): string[] {
  const unused = unusedData(volume);
  if (unused.length === 0) return [];
  const names = listed(unused.map((name) => `"${name}"`));
  return [`numbers at the nodes are not used: ${names}; "size" counts, and "stretching" with "direction"`];
}

/** That names of regions come to nothing. */
function unplacedLines({ unplacedRegions = [] }: Pick<FileMesh, "unplacedRegions">): string[] {
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
    ...(isKnown ? [`${plural(found.regions, "body")}, ${plural(found.cavities, "cavity")}`] : []),
    `area ${short(found.area)}${isKnown ? `, volume ${short(found.volume)}` : ""}`,
    boxText(found.box),
    edgesLine(found.edgeLengths),
    ...(found.flippedTriangles > 0
      ? [
          `${plural(found.flippedTriangles, "triangle")} not turned outward${isKnown ? ", as whole parts" : ""}`,
        ]
      : []),
    ...found.worst
      .slice(0, 3)
      .map(
        ({ triangle, smallestAngle, radiusRatio, centroid }) =>
          `among the worst: triangle ${triangle}, smallest angle ${smallestAngle.toFixed(2)}°, radius ratio ${radiusRatio.toFixed(3)}, at ${placeText(centroid)}`,
      ),
  ];
}

function notManifold({ nonManifoldEdges, nonManifoldNodes }: Omit<SurfaceInspection, "diagnostics">): string {
  const parts = [
    ...(nonManifoldEdges > 0 ? [`${plural(nonManifoldEdges, "edge")} of more than two triangles`] : []),
    ...(nonManifoldNodes > 0 ? [`${plural(nonManifoldNodes, "node")} where it touches itself`] : []),
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
        ({ tetrahedron, dihedral, centroid }) =>
          `among the worst: tetrahedron ${tetrahedron}, ${dihedral.min.toFixed(2)}° to ${dihedral.max.toFixed(2)}°, at ${placeText(centroid)}`,
      ),
  ];
}
