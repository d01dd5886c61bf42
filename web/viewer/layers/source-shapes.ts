import type { ProjectSource } from "tetrafront/project";
import type { Position } from "../../document/position";

/** Number of straight pieces of a circle. */
const circlePieces = 32;

type Vector = [number, number, number];

const add = (a: Position, b: Position): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const subtract = (a: Position, b: Position): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/** Appends the segment or the edges of the triangle to `ends`; of a point, a segment without length. */
export function appendEdges({ positions }: ProjectSource, origin: Position, ends: number[]): void {
  for (const [from, to] of edgesOf(positions)) ends.push(...subtract(from, origin), ...subtract(to, origin));
}

/** Appends the outline of all positions within the source's distance to `ends`: circles, and lines that join them. */
export function appendReach(
  { positions, distance = 0 }: Pick<ProjectSource, "positions" | "distance">,
  origin: Position,
  ends: number[],
): void {
  if (!(distance > 0)) return;
  for (const centre of positions) {
    for (let axis = 0; axis < 3; ++axis) appendCircle(subtract(centre, origin), axis, distance, ends);
  }
  if (positions.length === 1) return;
  for (const [from, to] of edgesOf(positions)) {
    for (const aside of acrossOf(subtract(to, from), distance)) {
      ends.push(...add(subtract(from, origin), aside), ...add(subtract(to, origin), aside));
    }
  }
}

/** The sides of the source's point, segment or triangle. */
function edgesOf(corners: readonly Position[]): (readonly [from: Position, to: Position])[] {
  const edges = corners.map((from, i) => [from, corners[(i + 1) % corners.length] ?? from] as const);
  return corners.length === 2 ? edges.slice(0, 1) : edges;
}

/** Four vectors of a length across a direction. */
function acrossOf([x, y, z]: Vector, length: number): Vector[] {
  const first: Vector = Math.abs(z) > Math.max(Math.abs(x), Math.abs(y)) ? [0, -z, y] : [-y, x, 0];
  const second: Vector = [
    y * first[2] - z * first[1],
    z * first[0] - x * first[2],
    x * first[1] - y * first[0],
  ];
  return [first, second].flatMap((across) => {
    const scale = length / (Math.hypot(...across) || 1);
    const [a, b, c]: Vector = [across[0] * scale, across[1] * scale, across[2] * scale];
    return [[a, b, c] as Vector, [-a, -b, -c] as Vector];
  });
}

/** Appends a circle across one axis. */
function appendCircle(centre: Vector, axis: number, radius: number, ends: number[]): void {
  const pointAt = (piece: number): Vector => {
    const angle = (2 * Math.PI * piece) / circlePieces;
    const point: Vector = [...centre];
    point[(axis + 1) % 3] = (point[(axis + 1) % 3] ?? 0) + radius * Math.cos(angle);
    point[(axis + 2) % 3] = (point[(axis + 2) % 3] ?? 0) + radius * Math.sin(angle);
    return point;
  };
  for (let piece = 0; piece < circlePieces; ++piece) ends.push(...pointAt(piece), ...pointAt(piece + 1));
}
