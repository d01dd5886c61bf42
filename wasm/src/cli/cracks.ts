/** Finds cracks: open boundaries of parts that face each other across a gap, which a weld within that distance closes. */
import type { Mesher } from "../api/mesher-interface.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { diagonalOf } from "../formats/near-points.js";
import type { SurfaceInput } from "../mesh/mesh.js";

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
 * or whose repair has filled holes and left more regions. `repaired`: what the repair without a weld has made.
 */
export async function crackWarning(
  mesher: Mesher,
  given: SurfaceInput,
  repaired: { readonly isFillable: boolean; readonly regions: number },
): Promise<Diagnostic[]> {
  const gap = crackWidth(given);
  if (gap === undefined) return [];
  for (const margin of MARGINS) {
    const weld = roundedUp(margin * gap);
    const { surface } = await mesher.repairSurface(given, { weld });
    const welded = await mesher.inspectSurface(surface);
    const isBetter = welded.isFillable && (!repaired.isFillable || welded.regions < repaired.regions);
    if (!isBetter) continue;
    const effect = repaired.isFillable
      ? `it is split into ${repaired.regions} regions, because holes were filled on both sides`
      : "it is not closed";
    const message = `the surface has a crack up to ${weld} wide; ${effect}`;
    return [
      packageDiagnostic("cracked-surface", message, `Use --weld ${weld} to close the crack.`, "warning"),
    ];
  }
  return [];
}

/** Rounds up to two digits. */
function roundedUp(value: number): number {
  const unit = 10 ** (Math.floor(Math.log10(value)) - 1);
  return Number((Math.ceil(value / unit) * unit).toPrecision(2));
}

/**
 * Returns the largest distance of a node on an open edge from the nearest one of another part; undefined if there is none, or
 * if the parts are not near each other everywhere.
 */
function crackWidth({ points, triangles }: SurfaceInput): number | undefined {
  const { nodes, partOf } = openNodes(triangles, points.length / 3);
  if (nodes.length === 0 || nodes.length > MAX_NODES) return undefined;
  const limit = LARGEST_GAP * diagonalOf(points);
  // Sorted by x, so that only near nodes are compared.
  const xOf = (node: number) => points[3 * node] ?? 0;
  const sorted = nodes.toSorted((a, b) => xOf(a) - xOf(b));
  let width = 0;
  for (const [i, node] of sorted.entries()) {
    let nearest = Infinity;
    for (const step of [-1, 1]) {
      for (let k = i + step; k >= 0 && k < sorted.length; k += step) {
        const other = sorted[k] ?? 0;
        if (Math.abs(xOf(other) - xOf(node)) > Math.min(nearest, limit)) break;
        if (partOf(other) !== partOf(node)) nearest = Math.min(nearest, distance(points, node, other));
      }
    }
    if (nearest > limit) return undefined;
    width = Math.max(width, nearest);
  }
  return width > 0 ? width : undefined;
}

function distance(points: Float64Array, one: number, other: number): number {
  const squares = [0, 1, 2].map((k) => ((points[3 * one + k] ?? 0) - (points[3 * other + k] ?? 0)) ** 2);
  return Math.sqrt(squares.reduce((sum, square) => sum + square, 0));
}

/** Returns the nodes of edges with one triangle, and which connected part a node belongs to. O(triangles). */
function openNodes(triangles: Uint32Array, count: number) {
  const parent = Uint32Array.from({ length: count }, (_, node) => node);
  const partOf = (node: number): number => {
    let root = node;
    while (parent[root] !== root) root = parent[root] ?? root;
    parent[node] = root;
    return root;
  };
  const edges = new Map<number, number>();
  triangles.forEach((from, corner) => {
    const to = triangles[corner % 3 === 2 ? corner - 2 : corner + 1] ?? 0;
    const edge = Math.min(from, to) * count + Math.max(from, to);
    edges.set(edge, (edges.get(edge) ?? 0) + 1);
    parent[Math.max(partOf(from), partOf(to))] = Math.min(partOf(from), partOf(to));
  });
  const open = new Set<number>();
  for (const [edge, uses] of edges) {
    if (uses === 1) open.add(Math.floor(edge / count)).add(edge % count);
  }
  return { nodes: [...open], partOf };
}
