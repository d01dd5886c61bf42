/** Patches of interfaces that a repair has cut out of the faces of solids. */
import type { MeshGroup, Mesh } from "../mesh/mesh.js";

/**
 * Returns the patches with those triangles in patches of their own, "base / post", that lie between two regions, unless their
 * patch has this name. O(n) for n triangles.
 */
export function withInterfacePatches(
  mesh: Pick<Mesh, "trianglePatch" | "patches" | "regions" | "triangleRegions">,
): Pick<Mesh, "trianglePatch" | "patches"> {
  const { trianglePatch, patches, regions, triangleRegions = new Uint32Array() } = mesh;
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
  const indexOf = (pair: string, color: MeshGroup["color"]): number => {
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
