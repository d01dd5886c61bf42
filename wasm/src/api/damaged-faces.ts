/** Faces of a CAD file whose triangles do not fit together, so that a repair has changed the surface there. */
import { PAUSE, STEP, type Steps } from "../base/steps.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { listed } from "../formats/groups.js";
import type { RepairChange } from "../mesh/inspection.js";
import type { Mesh } from "../mesh/mesh.js";

/**
 * Returns a note that names the faces at open edges, and those of a solid whose triangles a repair has cut, flipped or removed; none if the
 * repair has changed nothing. `given`: the surface of the file, each face a patch. O(triangles).
 */
export function* damagedFaces(given: Mesh, changes: readonly RepairChange[] = []): Steps<Diagnostic[]> {
  if (changes.length === 0) return [];
  const faces = new Set<number>();
  for (const triangle of yield* openTriangles(given)) faces.add(given.trianglePatch[triangle] ?? 0);
  // Solids of an assembly may intersect although the faces of each are sound.
  const isOneSolid = (given.surfaceRegions?.regions.length ?? 0) < 2;
  for (const change of isOneSolid ? changes : [])
    if (isOfDamage(change)) faces.add(given.trianglePatch[change.triangle] ?? 0);
  const names = [...faces].sort((a, b) => a - b).map((face) => given.patches[face]?.name ?? "");
  if (names.length === 0) return [];
  const [of, them] = names.length === 1 ? ["this face does", "it"] : ["these faces do", "them"];
  const message = `${of} not fit the others, so the surface was repaired there: ${listed(names)}`;
  return [
    packageDiagnostic(
      "damaged-faces",
      message,
      `Heal ${them} in the CAD program, or export the part again, if the shape must be exact there.`,
      "warning",
    ),
  ];
}

/** Triangles without area and those that are there twice are harmless. */
function isOfDamage(change: RepairChange): change is RepairChange & { readonly triangle: number } {
  return (
    change.kind === "resolved-intersection" ||
    change.kind === "removed-sheet" ||
    change.kind === "flipped-triangle"
  );
}

/** In place of the triangle at an edge that has several. */
const SHARED = -1;

/** Returns triangles at edges that have no other. */
function* openTriangles({ triangles, points }: Mesh): Steps<number[]> {
  const nodes = points.length / 3;
  const firstAt = new Map<number, number>();
  for (let i = 0; i < triangles.length; ++i) {
    if ((i + 1) % STEP === 0) yield PAUSE;
    const from = triangles[i] ?? 0;
    const to = triangles[i % 3 === 2 ? i - 2 : i + 1] ?? 0;
    const key = Math.min(from, to) * nodes + Math.max(from, to);
    firstAt.set(key, firstAt.has(key) ? SHARED : Math.floor(i / 3));
  }
  return [...firstAt.values()].filter((triangle) => triangle !== SHARED);
}
