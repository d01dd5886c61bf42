import type { ProjectBackground } from "tetrafront/project";
import { numbersPerNode, packedNodes, packedTetrahedra } from "./packed-grid";
import type { Position } from "./position";
import { forEachInSlices } from "./slices";

/**
 * Returns a coverage margin with which a grid covers every position between some corners; 0 for a grid without tetrahedra.
 * No position is further from the nearest tetrahedron than from any one node, and none further from that node than the
 * furthest corner. The margin is this distance, for the best node, relative to the least of the tetrahedra's longest edges.
 * Works in slices. O(nodes · corners + tetrahedra).
 */
export async function marginToCover(
  background: ProjectBackground,
  corners: readonly Position[],
): Promise<number> {
  const nodes = packedNodes(background.nodes);
  const tetrahedra = packedTetrahedra(background.tetrahedra);
  const firstOf = new Map<number, number>();
  await forEachInSlices(nodes.length / numbersPerNode, (i) => {
    firstOf.set(nodes[numbersPerNode * i] ?? 0, numbersPerNode * i);
  });
  const squaredDistance = (first: number, [x, y, z]: Position): number =>
    (x - (nodes[first + 1] ?? 0)) ** 2 +
    (y - (nodes[first + 2] ?? 0)) ** 2 +
    (z - (nodes[first + 3] ?? 0)) ** 2;
  const positionAt = (first: number): Position => [
    nodes[first + 1] ?? 0,
    nodes[first + 2] ?? 0,
    nodes[first + 3] ?? 0,
  ];
  let [shortest, reach] = [Infinity, Infinity];
  const furthest = (first: number): number =>
    corners.reduce((most, corner) => Math.max(most, squaredDistance(first, corner)), 0);
  await forEachInSlices(tetrahedra.length / 4, (t) => {
    const ends = [0, 1, 2, 3].map((k) => firstOf.get(tetrahedra[4 * t + k] ?? 0) ?? 0);
    let longest = 0;
    ends.forEach((end, k) => {
      reach = Math.min(reach, furthest(end));
      for (const other of ends.slice(0, k)) {
        longest = Math.max(longest, squaredDistance(other, positionAt(end)));
      }
    });
    shortest = Math.min(shortest, longest);
  });
  if (!(shortest > 0) || shortest === Infinity) return 0;
  return Math.sqrt(reach / shortest) * (1 + rounding);
}

/** The margin is compared after other roundings. */
const rounding = 1e-6;
