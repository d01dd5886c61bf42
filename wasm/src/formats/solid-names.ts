/** Names of regions from the solids or groups of a file that bound them: the format states no regions. */
import {
  isColorName,
  isNumberedSolid,
  type Mesh,
  type MeshGroup,
  type SurfaceRegions,
} from "../mesh/mesh.js";
import { NO_REGION } from "../generated/constants.js";
import { disjointSets } from "./components.js";
import { differentNames, hasGenericName } from "./groups.js";
import { nextCorner } from "./open-edges.js";

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
  const shells = shellsOf(surface.triangles, surface.points.length / 3);
  const outer = outerShells(surface, shells, regions);
  const patchOfShell = patchesOfShells(shells, trianglePatch);
  const found = outer.map((shell) => {
    const patch = patches[patchOfShell.get(shell) ?? -1];
    const isNamed = patch !== undefined && !hasGenericName(patch) && !isColorName(patch.name);
    return isNamed && !(patches.length === 1 && isNumberedSolid(patch.name)) ? patch.name : undefined;
  });
  return differentNames(found);
}

/**
 * Returns per triangle the least one that is connected to it over edges. Edges at which an even number of more than two triangles
 * meet connect nothing: there, solids touch each other. O(n) for few triangles per node.
 */
function shellsOf(triangles: Uint32Array, nodes: number): Uint32Array {
  const sets = disjointSets(triangles.length / 3);
  for (const corners of edgesOf(triangles, nodes)) {
    if (corners.length > 2 && corners.length % 2 === 0) continue;
    const [first = 0, ...others] = corners.map((corner) => Math.floor(corner / 3));
    for (const other of others) sets.join(first, other);
  }
  return Uint32Array.from({ length: triangles.length / 3 }, (_, t) => sets.rootOf(t));
}

/** Yields the corners at which each edge begins, in one of its directions. */
function* edgesOf(triangles: Uint32Array, nodes: number): Generator<readonly number[]> {
  const lowest = triangles.map((from, corner) => Math.min(from, triangles[nextCorner(corner)] ?? 0));
  const starts = new Uint32Array(nodes + 1);
  for (const node of lowest) starts[node + 1] = (starts[node + 1] ?? 0) + 1;
  for (let node = 0; node < nodes; node++) starts[node + 1] = (starts[node + 1] ?? 0) + (starts[node] ?? 0);
  const sorted = new Uint32Array(lowest.length);
  const next = starts.slice();
  lowest.forEach((node, corner) => {
    const at = next[node] ?? 0;
    sorted[at] = corner;
    next[node] = at + 1;
  });
  for (let node = 0; node < nodes; node++) {
    const byOther = new Map<number, number[]>();
    for (const corner of sorted.subarray(starts[node], starts[node + 1])) {
      const other = Math.max(triangles[corner] ?? 0, triangles[nextCorner(corner)] ?? 0);
      const known = byOther.get(other);
      if (known === undefined) byOther.set(other, [corner]);
      else known.push(corner);
    }
    yield* byOther.values();
  }
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
      outer[region] = shells[t] ?? 0;
    }
  });
  return outer;
}

/** Returns the patch of each shell whose triangles are all of one. */
function patchesOfShells(shells: Uint32Array, trianglePatch: Uint32Array): Map<number, number> {
  const patchOf = new Map<number, number>();
  const mixed = new Set<number>();
  shells.forEach((shell, t) => {
    const patch = trianglePatch[t] ?? 0;
    const known = patchOf.get(shell);
    if (known === undefined) patchOf.set(shell, patch);
    else if (known !== patch) mixed.add(shell);
  });
  for (const shell of mixed) patchOf.delete(shell);
  return patchOf;
}
