/** Statistics as lines of text. */
import { unusedData } from "../api/node-sizes.js";
import { plural } from "../base/plural.js";
import { positionText } from "../base/position-text.js";
import { short } from "../base/short.js";
import { listed } from "../formats/groups.js";
import type { Mesh } from "../mesh/mesh.js";
import type { EdgeLengths, MeshInspection, SurfaceInspection } from "../mesh/inspection.js";
import type { QualityReport } from "../mesh/quality.js";

/** Number of significant digits in text. */
const DIGITS = 6;
/** Number of digits that distinguish any two doubles. */
const MAX_DIGITS = 17;

/**
 * Returns "30.1° to 134.9°", rounded outward: an angle that is out of a range is never shown as its end. `digits`: those
 * after the decimal point.
 */
export function anglesText({ min, max }: Range, digits: number): string {
  return `${angleText(min, digits, Math.floor)} to ${angleText(max, digits, Math.ceil)}`;
}

/** `round`: Math.floor for a smallest angle, Math.ceil for a largest one. */
export function angleText(degrees: number, digits: number, round: (value: number) => number): string {
  const scale = 10 ** digits;
  return `${(round(degrees * scale) / scale).toFixed(digits)}°`;
}

interface Range {
  readonly min: number;
  readonly max: number;
}

/**
 * Returns "box (0, 0, 0) to (1, 1, 1)", with enough digits to show six of each edge length, however far from the
 * origin the box is. Coordinates that are rounding errors, below 1e-12 of the diagonal, are printed as 0. `whole`: the
 * box around everything, if this is the box of a part of it; edges below 1/100 of its diagonal have fewer digits.
 */
export function boxText(box: Box, whole: Box = box): string {
  const diagonal = diagonalOf(whole);
  const smallest = whole === box ? 0 : diagonal / 100;
  const rounded = (corner: readonly number[]) =>
    corner.map((value) => (Math.abs(value) < 1e-12 * diagonal ? 0 : value));
  const [low, high] = [rounded(box.low), rounded(box.high)];
  const digits = low.map((from, axis) => {
    const to = high[axis] ?? from;
    const length = Math.max(to - from, smallest);
    const beyond = Math.floor(Math.log10(Math.max(Math.abs(from), Math.abs(to)) / length));
    return length > 0 ? Math.min(MAX_DIGITS, DIGITS + Math.max(0, beyond)) : DIGITS;
  });
  const [from, to] = [low, high].map((corner) => corner.map((value, axis) => short(value, digits[axis])));
  return `box (${from?.join(", ")}) to (${to?.join(", ")})`;
}

const diagonalOf = ({ low, high }: Box): number =>
  Math.hypot(...low.map((from, axis) => (high[axis] ?? from) - from));

export interface Box {
  readonly low: readonly number[];
  readonly high: readonly number[];
}

/** Returns a line if the node order of some tetrahedra in the file is opposite to that of the others. */
export function mixedOrientationLines({ points, tetrahedra, invertedTetrahedra }: Mesh): string[] {
  const count = invertedTetrahedra?.length ?? 0;
  if (invertedTetrahedra === undefined || count === 0) return [];
  const all = plural(tetrahedra.length / 4, "tetrahedron");
  const numbers = listed(Array.from(invertedTetrahedra, String));
  const node = 3 * (tetrahedra[4 * (invertedTetrahedra[0] ?? 0)] ?? 0);
  const position = positionText([...points.subarray(node, node + 3)]);
  return [
    `${count} of ${all} ${count === 1 ? "is" : "are"} inverted, and ${count === 1 ? "was" : "were"} reoriented: ${numbers} (counted from 0), the first at ${position}`,
  ];
}

/** Returns a line if the node order of all tetrahedra in the file is the opposite one, which is not a problem. */
export function oppositeOrderLines({ tetrahedra, reversedTetrahedra }: Mesh): string[] {
  const isOtherWay = tetrahedra.length > 0 && reversedTetrahedra === tetrahedra.length / 4;
  return isOtherWay ? ["the file uses the opposite node order: all tetrahedra were reoriented"] : [];
}

/** Reports values at the nodes of a background grid that are not used. */
export function unusedLines(volume: Pick<Mesh, "nodeData">): string[] {
  const unused = unusedData(volume);
  if (unused.length === 0) return [];
  const names = listed(unused.map((name) => `"${name}"`));
  return [
    `values at the nodes are not used: ${names}; only "metric", "size", and "stretching" with "direction" (also second ones) are`,
  ];
}

/** Returns a sentence about points that a command does not use. */
export function unusedPointLines({ regionPoints }: Pick<Mesh, "regionPoints">): string[] {
  const { holes = [], regions = [] } = regionPoints ?? {};
  const counts = [
    ...(holes.length > 0 ? [plural(holes.length, "hole point")] : []),
    ...(regions.length > 0 ? [plural(regions.length, "region point")] : []),
  ];
  return counts.length === 0 ? [] : [`${counts.join(" and ")} not written; \`tetrafront mesh\` uses them`];
}

export function surfaceLines(found: Omit<SurfaceInspection, "diagnostics">): string[] {
  if (found.box === null) return [];
  const isKnown = found.isFillable;
  return [
    `${plural(found.triangles, "triangle")}, ${plural(found.nodes, "node")}, ${plural(found.edges, "edge")}`,
    [
      found.isClosed ? "closed" : `not closed (${plural(found.openEdges, "open edge")})`,
      found.isManifold ? "manifold" : `not manifold (${notManifold(found)})`,
      found.isEmbedded ? "without self-intersections" : "self-intersecting",
    ].join(", "),
    ...(isKnown ? [`${plural(found.regions, "region")}, ${plural(found.cavities, "cavity")}`] : []),
    `area ${short(found.area)}${isKnown ? `, volume ${short(found.volume)}` : ""}`,
    boxText(found.box),
    edgesLine(found.edgeLengths),
    ...(found.flippedTriangles > 0
      ? [
          `${plural(found.flippedTriangles, "triangle")} facing inward${isKnown ? ", as whole components" : ""}`,
        ]
      : []),
    ...found.worst
      .slice(0, 3)
      .map(
        ({ triangle, smallestAngle, radiusRatio, centroid }) =>
          `among the worst: triangle ${triangle}, smallest angle ${smallestAngle.toFixed(2)}°, radius ratio ${radiusRatio.toFixed(3)}, at ${positionText(centroid)}`,
      ),
  ];
}

function notManifold({ nonManifoldEdges, nonManifoldNodes }: Omit<SurfaceInspection, "diagnostics">): string {
  const parts = [
    ...(nonManifoldEdges > 0 ? [`${plural(nonManifoldEdges, "edge")} with more than two triangles`] : []),
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
    `dihedral angles ${anglesText(dihedral, 2)}`,
    `radius ratio: minimum ${radiusRatio.min.toFixed(3)}, mean ${radiusRatio.mean.toFixed(3)}`,
  ];
}

function edgesLine({ shortest, mean, longest }: EdgeLengths): string {
  return `edges ${short(shortest)} to ${short(longest)}, mean ${short(mean)}`;
}

const BAR_WIDTH = 40;

/** Returns the histogram of all dihedral angles, and the worst elements. */
export function qualityLines({ regions, worst, binWidths }: QualityReport): string[] {
  const bins = regions.reduce<number[]>(
    (sum, { dihedral }) => dihedral.map((count, i) => count + (sum[i] ?? 0)),
    [],
  );
  const largest = Math.max(1, ...bins);
  const bars = bins.flatMap((count, i) => {
    if (count === 0) return [];
    const from = i * binWidths.dihedral;
    const range = `${from}° to ${from + binWidths.dihedral}°`.padStart(12);
    return [`${range} ${"#".repeat(Math.ceil((BAR_WIDTH * count) / largest))} ${count}`];
  });
  return [
    "dihedral angles:",
    ...bars,
    ...worst
      .slice(0, 5)
      .map(
        ({ tetrahedron, dihedral, centroid }) =>
          `among the worst: tetrahedron ${tetrahedron}, ${anglesText(dihedral, 2)}, at ${positionText(centroid)}`,
      ),
  ];
}
