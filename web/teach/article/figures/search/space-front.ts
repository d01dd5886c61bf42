/** A front in space whose nodes are searched: a closed surface with a deep bay, where its faces are small. */
import type { Position } from "../../../../document/position";
import { add, addScaled, dot, scale, unit } from "../../../../document/vectors";
import { CellTree, HashGrid, ListSearch, type Cell, type Structure } from "./search-rules";

export interface SpaceFront {
  readonly nodes: readonly Position[];
  /** Three nodes of each face, counter-clockwise from outside. */
  readonly faces: readonly (readonly [number, number, number])[];
}

/** The front lies in the cube of side 1 around the origin. */
export const wholeCube: Cell<Position> = { at: [-0.5, -0.5, -0.5], side: 1 };
/** Side of the cells of the grid. */
const gridSide = 0.1;

const golden = (1 + Math.sqrt(5)) / 2;
/** Corners of an icosahedron. */
const corners: readonly Position[] = [
  [-1, golden, 0],
  [1, golden, 0],
  [-1, -golden, 0],
  [1, -golden, 0],
  [0, -1, golden],
  [0, 1, golden],
  [0, -1, -golden],
  [0, 1, -golden],
  [golden, 0, -1],
  [golden, 0, 1],
  [-golden, 0, -1],
  [-golden, 0, 1],
];
/** Its faces, counter-clockwise from outside. */
const triangles = [
  [0, 11, 5],
  [0, 5, 1],
  [0, 1, 7],
  [0, 7, 10],
  [0, 10, 11],
  [1, 5, 9],
  [5, 11, 4],
  [11, 10, 2],
  [10, 7, 6],
  [7, 1, 8],
  [3, 9, 4],
  [3, 4, 2],
  [3, 2, 6],
  [3, 6, 8],
  [3, 8, 9],
  [4, 9, 5],
  [2, 4, 11],
  [6, 2, 10],
  [8, 6, 7],
  [9, 8, 1],
] as const;

/** The direction of the bay. */
const towardsBay: Position = unit([-0.8, -0.25, 0.42]) ?? [-1, 0, 0];
/** How much the nodes are drawn towards the bay: 0 not at all, 1 all into one point. */
const pull = 0.5;

/** Returns the point of the surface that belongs to a direction. */
function surfaceAt(direction: Position): Position {
  const at = unit(addScaled(direction, towardsBay, pull)) ?? direction;
  const away = Math.acos(Math.min(1, Math.max(-1, dot(at, towardsBay))));
  const wave = 0.025 * Math.cos(3 * Math.atan2(at[1], at[0])) * Math.hypot(at[0], at[1]);
  return scale(at, 0.43 + wave - 0.2 * Math.exp(-((away / 0.55) ** 2)));
}

/** Returns a front whose surface has 20 parts², and thus 10 parts² + 2 nodes: each side of an icosahedron is cut into equal parts. */
export function makeSpaceFront(parts: number): SpaceFront {
  const nodes: Position[] = [];
  const faces: (readonly [number, number, number])[] = [];
  const known = new Map<string, number>();
  const nodeAt = (sum: Position): number => {
    const direction = unit(sum) ?? sum;
    const key = direction.map((x) => Math.round(x * 1e6)).join(" ");
    const old = known.get(key);
    if (old !== undefined) return old;
    known.set(key, nodes.length);
    return nodes.push(surfaceAt(direction)) - 1;
  };
  for (const [i, j, k] of triangles) {
    const [a, b, c] = [corners[i], corners[j], corners[k]];
    if (!a || !b || !c) continue;
    const at = (u: number, v: number): number =>
      nodeAt(add(add(scale(a, parts - u - v), scale(b, u)), scale(c, v)));
    for (let u = 0; u < parts; u++)
      for (let v = 0; u + v < parts; v++) {
        faces.push([at(u, v), at(u + 1, v), at(u, v + 1)]);
        if (u + v + 1 < parts) faces.push([at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)]);
      }
  }
  return { nodes, faces };
}

export const spaceStructureNames = ["list", "octree", "grid"] as const;
export type SpaceStructureName = (typeof spaceStructureNames)[number];

export const spaceStructuresOf = (
  nodes: readonly Position[],
): Readonly<Record<SpaceStructureName, Structure<Position>>> => ({
  list: new ListSearch(nodes),
  octree: new CellTree(nodes, wholeCube),
  grid: new HashGrid(nodes, gridSide),
});
