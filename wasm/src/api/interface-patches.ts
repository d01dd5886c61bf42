/** Patches of interfaces that a repair has cut out of the faces of solids. */
import type { FileGroup } from "../mesh/file-mesh.js";

/** The triangles of a mesh with the groups of its file. */
export interface PatchedRegions {
  /** Per triangle: index in `patches`. */
  readonly trianglePatch: Uint32Array;
  readonly patches: readonly FileGroup[];
  /** Two per triangle: indices in `regions`; others where there is none. */
  readonly triangleRegions: ArrayLike<number>;
  readonly regions: readonly Pick<FileGroup, "name">[];
}

/**
 * Returns the patches with those triangles in patches of their own, "base / post", that lie between two regions, unless their
 * patch has this name. O(n) for n triangles.
 */
export function withInterfacePatches(
  mesh: PatchedRegions,
): Pick<PatchedRegions, "trianglePatch" | "patches"> {
  const { trianglePatch, patches, regions, triangleRegions } = mesh;
  const pairOf = (t: number): string => {
    const [a = 0, b = 0] = [triangleRegions[2 * t], triangleRegions[2 * t + 1]].sort(
      (x, y) => Number(x) - Number(y),
    );
    const [one, other] = [regions[a], regions[b]];
    return a === b || one === undefined || other === undefined ? "" : `${one.name} / ${other.name}`;
  };
  const isNamed = (patch: number, pair: string) => {
    const { name = "" } = patches[patch] ?? {};
    return name === pair || name.startsWith(`${pair} `);
  };
  const made = [...patches];
  const indices = new Map<string, number>();
  let tag = patches.reduce((last, patch) => Math.max(last, patch.tag), 0);
  const indexOf = (pair: string, color: FileGroup["color"]): number => {
    const known = indices.get(pair);
    if (known !== undefined) return known;
    const taken = patches.filter(({ name }) => name === pair || name.startsWith(`${pair} `)).length;
    indices.set(pair, made.length);
    return made.push({ name: taken === 0 ? pair : `${pair} ${taken + 1}`, tag: ++tag, color }) - 1;
  };
  const changed = trianglePatch.map((patch, t) => {
    const pair = pairOf(t);
    return pair === "" || isNamed(patch, pair) ? patch : indexOf(pair, patches[patch]?.color);
  });
  return { trianglePatch: changed, patches: made };
}
