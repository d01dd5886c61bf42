/** Finds cracks: open boundaries of parts that face each other across a gap, which a weld within that distance closes. */
import type { SurfaceMesher } from "./surface-mesher.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { roundedUp } from "../base/rounded-up.js";
import { withoutPause } from "../base/steps.js";
import { nodeComponentsOf } from "../formats/components.js";
import { openEdges } from "../formats/open-edges.js";
import { diagonalOf, distanceAlong } from "../formats/near-points.js";
import type { InnerShells } from "../generated/constants.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import { withoutRegions } from "./stated-solids.js";

/** Largest gap / diagonal of a crack. */
const LARGEST_GAP = 0.03;

/** Largest number of nodes on open edges that are compared with each other. */
const MAX_NODES = 20_000;

/**
 * Distances that are tried, relative to the measured gap. Where several parts meet in a node, as loose triangles do, some
 * are further from each other than the nearest two.
 */
const MARGINS = [1.01, 2, 3];

/**
 * Returns a warning that names the distance of a weld, if that closes a surface which has a crack: one that cannot be filled,
 * or whose repair has filled holes and left more regions. `repaired`: what the repair without a weld has made, with the same `innerShells`.
 */
export async function crackWarning(
  mesher: Pick<SurfaceMesher, "repairSurface" | "inspectSurface">,
  given: SurfaceInput,
  repaired: { readonly isFillable: boolean; readonly regions: number },
  innerShells?: InnerShells,
): Promise<Diagnostic[]> {
  const gap = largestGap(given);
  if (gap === undefined) return [];
  for (const margin of MARGINS) {
    const weld = roundedUp(margin * gap);
    const { mesh } = await mesher.repairSurface(given, { weld, innerShells });
    const welded = await mesher.inspectSurface(withoutRegions(mesh), { innerShells });
    const isBetter = welded.isFillable && (!repaired.isFillable || welded.regions < repaired.regions);
    if (!isBetter) continue;
    const effect = repaired.isFillable
      ? `it is split into ${repaired.regions} regions, because holes were filled on both sides`
      : "it is not closed";
    const message = `the surface has a crack up to ${weld} wide; ${effect}`;
    return [
      packageDiagnostic("cracked-surface", message, `Use \`weld: ${weld}\` to close the crack.`, "warning"),
    ];
  }
  return [];
}

/**
 * Returns the largest distance of a node on an open edge from the nearest one of another part; undefined if there is none, or
 * if the parts are not near each other everywhere.
 */
function largestGap({ points, triangles }: SurfaceInput): number | undefined {
  const nodes = new Set(withoutPause(openEdges(triangles, points.length / 3)));
  if (nodes.size === 0 || nodes.size > MAX_NODES) return undefined;
  const limit = LARGEST_GAP * diagonalOf(points);
  // Sorted along one direction, so that only near nodes are compared.
  const sorted = [...nodes]
    .map((node) => ({ node, along: distanceAlong(points, node) }))
    .sort((a, b) => a.along - b.along);
  const along = Float64Array.from(sorted, (one) => one.along);
  const order = Uint32Array.from(sorted, ({ node }) => node);
  const parts = nodeComponentsOf(triangles, points.length / 3);
  const partOf = order.map((node) => parts[node] ?? 0);
  let width = 0;
  for (const [i, node] of order.entries()) {
    let nearest = limit * limit;
    let isNear = false;
    for (const step of [-1, 1]) {
      for (let k = i + step; k >= 0 && k < order.length; k += step) {
        const ahead = (along[k] ?? 0) - (along[i] ?? 0);
        if (ahead * ahead > nearest) break;
        if (partOf[k] === partOf[i]) continue;
        const square = squaredDistance(points, node, order[k] ?? 0);
        if (square > nearest) continue;
        nearest = square;
        isNear = true;
      }
    }
    if (!isNear) return undefined;
    width = Math.max(width, nearest);
  }
  return width > 0 ? Math.sqrt(width) : undefined;
}

function squaredDistance(points: Float64Array, one: number, other: number): number {
  const x = (points[3 * one] ?? 0) - (points[3 * other] ?? 0);
  const y = (points[3 * one + 1] ?? 0) - (points[3 * other + 1] ?? 0);
  const z = (points[3 * one + 2] ?? 0) - (points[3 * other + 2] ?? 0);
  return x * x + y * y + z * z;
}
