/** Assigns the triangles of filled holes to the patches around them. */
import { NO_ORIGIN } from "../generated/constants.js";
import type { Mesh } from "../mesh/mesh.js";

/**
 * Returns a surface that was repaired, without the patch of filled holes: their triangles belong to a
 * patch beside them, so that their edges are not kept as feature lines by a remeshing. A hole between several patches is
 * divided among them.
 */
export function withoutFilledPatch(surface: Mesh): Mesh {
  const { origin, triangles, trianglePatch, patches } = surface;
  const filled = patches.length - 1;
  const isFilled = (t: number) => origin?.[t] === NO_ORIGIN && trianglePatch[t] === filled;
  const waiting = Array.from(trianglePatch.keys()).filter(isFilled);
  if (filled < 1 || waiting.length === 0) return surface;
  const beside = trianglesByEdge(triangles);
  const patchOf = trianglePatch.slice();
  const open = new Set(waiting);
  // From the rims inward.
  for (let isChanged = true; isChanged && open.size > 0;) {
    isChanged = false;
    for (const t of [...open]) {
      const known = [0, 1, 2]
        .flatMap((k) => beside.get(edgeKey(triangles, t, k)) ?? [])
        .find((other) => !open.has(other));
      if (known === undefined) continue;
      patchOf[t] = patchOf[known] ?? 0;
      open.delete(t);
      isChanged = true;
    }
  }
  for (const t of open) patchOf[t] = 0;
  return { ...surface, trianglePatch: patchOf, patches: patches.slice(0, filled) };
}

function edgeKey(triangles: Uint32Array, triangle: number, corner: number): string {
  const [a = 0, b = 0] = [corner, (corner + 1) % 3].map((k) => triangles[3 * triangle + k]);
  return a < b ? `${a} ${b}` : `${b} ${a}`;
}

function trianglesByEdge(triangles: Uint32Array): Map<string, number[]> {
  const beside = new Map<string, number[]>();
  for (let t = 0; t < triangles.length / 3; t++) {
    for (const k of [0, 1, 2]) {
      const key = edgeKey(triangles, t, k);
      const known = beside.get(key);
      if (known === undefined) beside.set(key, [t]);
      else known.push(t);
    }
  }
  return beside;
}
