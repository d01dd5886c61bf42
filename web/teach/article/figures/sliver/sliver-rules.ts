/** Four points: the angles, edges and volume of their tetrahedron. */
import type { Position } from "../../../../document/position";
import { cross, distance, dot, length, subtract } from "../../../../document/vectors";

export type Four = readonly [Position, Position, Position, Position];

/** The edges of a tetrahedron by their ends. An edge and the one opposite to it are three places apart. */
export const tetrahedronEdges = [
  [0, 1],
  [0, 2],
  [0, 3],
  [2, 3],
  [1, 3],
  [1, 2],
] as const;

export interface FourMeasures {
  /** Lengths of the six edges. */
  readonly edges: readonly number[];
  /** Dihedral angles at the six edges, in degrees. */
  readonly angles: readonly number[];
  readonly volume: number;
  /** Three times the radius of the inner sphere, divided by that of the outer one: 1 if all edges are equal, 0 if flat. */
  readonly radiusRatio: number;
}

/** Returns the measures of four points; their order does not matter. */
export function measureFour(four: Four): FourMeasures {
  const edges = tetrahedronEdges.map(([a, b]) => distance(four[a], four[b]));
  const angles = tetrahedronEdges.map((_edge, index) => dihedralAngle(four, index));
  const [u, v, w] = [1, 2, 3].map((i) => subtract(four[i] ?? four[0], four[0])) as [
    Position,
    Position,
    Position,
  ];
  const volume = Math.abs(dot(u, cross(v, w))) / 6;
  const area = [0, 1, 2, 3].reduce((sum, left) => sum + areaWithout(four, left), 0);
  // The outer radius by the products of opposite edges (A. L. Crelle, 1821).
  const [p, q, r] = [0, 1, 2].map((i) => (edges[i] ?? 0) * (edges[i + 3] ?? 0)) as [number, number, number];
  const product = Math.sqrt(Math.max(0, (p + q + r) * (p + q - r) * (p - q + r) * (-p + q + r)));
  const outer = product / (24 * volume);
  const inner = (3 * volume) / area;
  return { edges, angles, volume, radiusRatio: volume > 0 && product > 0 ? (3 * inner) / outer : 0 };
}

/** Returns the angle between the two faces at an edge, in degrees: 0 or 180 if they lie in one plane. */
function dihedralAngle(four: Four, edge: number): number {
  const [a, b] = tetrahedronEdges[edge] ?? [0, 1];
  const [c, d] = tetrahedronEdges[(edge + 3) % 6] ?? [2, 3];
  const along = subtract(four[b], four[a]);
  const first = cross(along, subtract(four[c], four[a]));
  const second = cross(along, subtract(four[d], four[a]));
  return (Math.atan2(length(cross(first, second)), dot(first, second)) * 180) / Math.PI;
}

function areaWithout(four: Four, left: number): number {
  const [a, b, c] = four.filter((_corner, index) => index !== left) as [Position, Position, Position];
  return length(cross(subtract(b, a), subtract(c, a))) / 2;
}

/** What is wrong with a tetrahedron, in the words of the field. */
export type FourKind = "good" | "sliver" | "cap" | "needle" | "wedge" | "poor";

/** Angles below and above which an element is poor. */
export const poorAngles = { min: 30, max: 135 } as const;
/** Edges count as alike if the longest is at most so many times the shortest: the diagonal of a square, and a little. */
const alike = 1.6;

/**
 * Names a tetrahedron. A needle has one short face and a wedge one short edge, whatever their angles; a sliver has edges that are
 * alike and two large angles, opposite to each other; a cap has a corner near the face opposite, and so three large angles.
 */
export function kindOf({ edges, angles }: FourMeasures): FourKind {
  const longest = Math.max(...edges);
  const short = edges.filter((edge) => edge < longest / 3).length;
  if (short === 3) return "needle";
  if (short === 1) return "wedge";
  if (Math.min(...angles) >= poorAngles.min && Math.max(...angles) <= poorAngles.max) return "good";
  const large = angles.filter((angle) => angle > poorAngles.max).length;
  if (large === 3) return "cap";
  return large === 2 && longest / Math.min(...edges) <= alike ? "sliver" : "poor";
}
