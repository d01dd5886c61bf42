/** Solids of surfaces that state none, such as the "solid" blocks of an STL file: patches that are closed by themselves. */
import { type Steps, stepwise } from "../base/steps.js";
import { type AssemblyPart, assemblyOf } from "./assembly.js";
import { openEdges } from "./open-edges.js";
import { enclosedVolumes } from "./sixfold-volume.js";
import { surfaceOf } from "./surface-file.js";
import type { Mesh } from "../mesh/mesh.js";
import { noVolume } from "./boundary.js";

/**
 * Returns a surface with a region per patch, named after it, if each of several patches is closed and encloses a volume; else
 * undefined. A patch that faces inward is the boundary of a cavity, not a solid. O(n log n).
 */
export function* solidsOfPatches(given: Mesh): Steps<Mesh | undefined> {
  const { surfaceRegions, regionPoints, patches, notes, duplicateTriangles = 0 } = given;
  const isStated = surfaceRegions !== undefined || regionPoints !== undefined;
  if (isStated || patches.length < 2 || duplicateTriangles > 0) return undefined;
  if (!(yield* areClosed(given)) || !(yield* faceOutward(given))) return undefined;
  const parts: AssemblyPart[] = [];
  const owned = patches.map((): number[] => []);
  yield* stepwise(given.trianglePatch.length, (t) => {
    owned[given.trianglePatch[t] ?? 0]?.push(t);
  });
  for (const [p, patch] of patches.entries()) {
    const own = owned[p] ?? [];
    const triangles = Uint32Array.from(own.flatMap((t) => [...given.triangles.subarray(3 * t, 3 * t + 3)]));
    const trianglePatch = new Uint32Array(own.length);
    // The name is that of the solid.
    const named = [{ ...patch, name: "" }];
    const surface = { ...noVolume(), points: given.points, triangles, trianglePatch, patches: named };
    if (own.length > 0) parts.push({ name: patch.name, surface });
  }
  const { unit } = given;
  const made = yield* surfaceOf(yield* assemblyOf(parts));
  return { ...made, ...(unit && { unit }), ...(notes && { notes }) };
}

/** Returns whether each patch has no open edges, even without the triangles of others. */
function* areClosed({ points, triangles, trianglePatch, patches }: Mesh): Steps<boolean> {
  // A node is another one in each patch.
  const nodeOf = new Map<number, number>();
  const own = new Uint32Array(triangles.length);
  yield* stepwise(triangles.length, (corner) => {
    const patch = trianglePatch[Math.floor(corner / 3)] ?? 0;
    const key = (triangles[corner] ?? 0) * patches.length + patch;
    const node = nodeOf.get(key) ?? nodeOf.size;
    nodeOf.set(key, node);
    own[corner] = node;
  });
  return points.length > 0 && (yield* openEdges(own, nodeOf.size)).length === 0;
}

function* faceOutward(surface: Mesh): Steps<boolean> {
  const { trianglePatch, patches } = surface;
  const volumes = yield* enclosedVolumes(surface, patches.length, (t) => trianglePatch[t]);
  const used = new Set(trianglePatch);
  return volumes.every((volume, patch) => volume > 0 || !used.has(patch));
}
