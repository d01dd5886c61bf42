/** Transfers the patches and regions of a surface to its repaired, refined or remeshed version. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { doubles, integers } from "../calls/schemas.js";
import { countOf } from "../formats/groups.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import { NO_ORIGIN, NO_REGION } from "../generated/constants.js";
import type { FileGroup } from "../mesh/file-mesh.js";
import type { SurfaceRepair } from "../mesh/inspection.js";
import { withPatches } from "../mesh/mesh-checks.js";
import { chainedOrigins } from "./surface-numbers.js";

const repairedTriangles = v.object({
  surface: v.object({ points: doubles(3), triangles: integers(3) }),
  origin: integers(),
});

/**
 * Returns a repaired, refined or remeshed surface with the patches and regions of the given one, and with the indices
 * there of its triangles and nodes, which messages use. Triangles that fill holes form one more patch, the last, named
 * "filled holes". Throws a `MesherError` if an argument is not a surface or a repair.
 *
 *     const repair = await mesher.repairSurface(file, { weld: 1e-6 });
 *     const surface = repairedSurface(file, repair);
 */
export function repairedSurface(
  given: SurfaceFile,
  repair: Pick<SurfaceRepair, "surface" | "origin">,
): SurfaceFile {
  checkArgument("given", given, withPatches);
  checkArgument("repair", repair, repairedTriangles);
  const { surface, origin } = repair;
  const added = given.patches.length;
  const trianglePatch = origin.map((from) => (from === NO_ORIGIN ? added : (given.trianglePatch[from] ?? 0)));
  const lastTag = given.patches.reduce((most, { tag }) => Math.max(most, tag), 0);
  const filled: FileGroup = { name: "filled holes", tag: lastTag + 1 };
  const hasFilled = countOf(trianglePatch) > added;
  const numbers = {
    origin: chainedOrigins(given.origin, origin),
    nodeOrigin: surface.nodeOrigin && chainedOrigins(given.nodeOrigin, surface.nodeOrigin),
  };
  const patches = hasFilled ? [...given.patches, filled] : given.patches;
  const { surfaceRegions, givenRegions, regionPoints } = given;
  const known = surface.givenRegions?.triangleRegions;
  const regionsBeside = ({ triangleRegions: beside }: { readonly triangleRegions: Uint32Array }) =>
    known?.slice() ??
    new Uint32Array(2 * origin.length).map((_, side) => {
      const from = origin[side >>> 1] ?? NO_ORIGIN;
      return from === NO_ORIGIN ? NO_REGION : (beside[2 * from + (side & 1)] ?? NO_REGION);
    });
  return {
    ...surface,
    ...numbers,
    trianglePatch,
    patches,
    ...(surfaceRegions && {
      surfaceRegions: { ...surfaceRegions, triangleRegions: regionsBeside(surfaceRegions) },
    }),
    ...(givenRegions && {
      givenRegions: { ...givenRegions, triangleRegions: regionsBeside(givenRegions) },
    }),
    ...(regionPoints && { regionPoints }),
  };
}
