/** Names of regions from the solids or groups of a file that bound them: the format states no regions. */
import {
  isColorName,
  isNumberedSolid,
  type Mesh,
  type MeshGroup,
  type SurfaceRegions,
} from "../mesh/mesh.js";
import { NO_REGION } from "../generated/constants.js";
import { differentNames, hasGenericName } from "./groups.js";

/** Triangles with the regions on both sides. */
type TrianglesBetween = Pick<Mesh, "points" | "triangles"> & Pick<SurfaceRegions, "triangleRegions">;

/**
 * Returns the name of each region: that of the patch which alone is its outer shell; undefined for other regions, and without a
 * name. Names that several regions would have are numbered: "bolt", "bolt 2". `trianglePatch`: indices in `patches`. O(n).
 */
export function namesOfSolids(
  surface: TrianglesBetween,
  trianglePatch: Uint32Array,
  patches: readonly MeshGroup[],
  regions: number,
): (string | undefined)[] {
  const shells = shellsOfSides(surface, regions);
  const outer = outerShells(surface, shells, regions);
  const patchOfShell = patchesOfShells(shells, trianglePatch);
  const found = outer.map((shell) => {
    const patch = patches[patchOfShell.get(shell) ?? -1];
    const isNamed = patch !== undefined && !hasGenericName(patch) && !isColorName(patch.name);
    return isNamed && !(patches.length === 1 && isNumberedSolid(patch.name)) ? patch.name : undefined;
  });
  return differentNames(found);
}

/** Returns per triangle the least node of the triangles that are connected to it. */
export function shellsOf(triangles: Uint32Array, nodes: number): Uint32Array {
  const parent = Uint32Array.from({ length: nodes }, (_, node) => node);
  const rootOf = (node: number): number => {
    let at = node;
    for (let next = parent[at] ?? at; next !== at; next = parent[at] ?? at) {
      parent[at] = parent[next] ?? next;
      at = next;
    }
    return at;
  };
  for (let t = 0; t < triangles.length; t += 3) {
    for (const other of [t + 1, t + 2]) {
      const [a, b] = [rootOf(triangles[t] ?? 0), rootOf(triangles[other] ?? 0)];
      parent[Math.max(a, b)] = Math.min(a, b);
    }
  }
  return Uint32Array.from({ length: triangles.length / 3 }, (_, t) => rootOf(triangles[3 * t] ?? 0));
}

/**
 * Returns per side of a triangle the shell of its region there, which is connected over nodes of this region: solids that touch in
 * an edge or a node have one shell each.
 */
function shellsOfSides({ triangles, triangleRegions }: TrianglesBetween, regions: number): Uint32Array {
  const nodeOf = new Map<number, number>();
  const corners = new Uint32Array(3 * triangleRegions.length);
  triangleRegions.forEach((region, side) => {
    const beside = Math.min(region, regions);
    const t = side >>> 1;
    for (let k = 0; k < 3; k++) {
      const key = (triangles[3 * t + k] ?? 0) * (regions + 1) + beside;
      const node = nodeOf.get(key) ?? nodeOf.size;
      nodeOf.set(key, node);
      corners[3 * side + k] = node;
    }
  });
  return shellsOf(corners, nodeOf.size);
}

/** Returns the shell of each region that has a node farthest along x: nothing of the region lies outside of it. */
function outerShells(
  { points, triangles, triangleRegions }: TrianglesBetween,
  shells: Uint32Array,
  regions: number,
): number[] {
  const outer = Array.from({ length: regions }, () => -1);
  const farthest = Array.from({ length: regions }, () => -Infinity);
  triangleRegions.forEach((region, side) => {
    if (region === NO_REGION) return;
    const t = side >>> 1;
    for (const node of triangles.subarray(3 * t, 3 * t + 3)) {
      const x = points[3 * node] ?? 0;
      if (x <= (farthest[region] ?? 0)) continue;
      farthest[region] = x;
      outer[region] = shells[side] ?? 0;
    }
  });
  return outer;
}

/** Returns the patch of each shell whose triangles are all of one. */
function patchesOfShells(shells: Uint32Array, trianglePatch: Uint32Array): Map<number, number> {
  const patchOf = new Map<number, number>();
  const mixed = new Set<number>();
  shells.forEach((shell, side) => {
    const patch = trianglePatch[side >>> 1] ?? 0;
    const known = patchOf.get(shell);
    if (known === undefined) patchOf.set(shell, patch);
    else if (known !== patch) mixed.add(shell);
  });
  for (const shell of mixed) patchOf.delete(shell);
  return patchOf;
}
