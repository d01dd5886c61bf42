import type { Manifold, ManifoldToplevel } from "manifold-3d";
import { PointIndex } from "../point-index";
import type { Position } from "../position";
import type { BooleanKind } from "./kinds";
import type { Solid } from "./solids";

/** Boolean operations on two solids, by the library Manifold (Lalish, https://github.com/elalish/manifold). */

/** The boundary of what an operation gives. Triangles know the patch that they are part of. */
export interface Combined {
  /** x y z per node: exact where the node is one of a solid, else rounded to single precision. */
  readonly points: Float64Array;
  /** Three nodes per triangle, counter-clockwise as seen from outside. */
  readonly triangles: Uint32Array;
  /** Per triangle: 0 or 1 for the first or the second solid. */
  readonly solid: Uint8Array;
  /** Per triangle: index of its patch in its solid. */
  readonly patch: Uint32Array;
}

/** Distance within which a node of the result is one of a solid, relative to the extent: the library computes in floats. */
const nodeTolerance = 1e-6;

/** Returns the boundary of a combination; null if the library rejects a solid, or if nothing is left. */
export function combine(
  library: ManifoldToplevel,
  first: Solid,
  second: Solid,
  kind: BooleanKind,
): Combined | null {
  const frame = frameOf([first, second]);
  const ids = library.Manifold.reserveIDs(2);
  const made: Manifold[] = [];
  const keep = (manifold: Manifold): Manifold => {
    made.push(manifold);
    return manifold;
  };
  try {
    const [a, b] = [first, second].map((solid, index) =>
      keep(manifoldOf(library, solid, ids + index, frame)),
    );
    if (!a || !b || a.status() !== "NoError" || b.status() !== "NoError") return null;
    const result = keep(kind === "union" ? a.add(b) : kind === "difference" ? a.subtract(b) : a.intersect(b));
    return result.isEmpty() ? null : combinedOf(result, ids, [first, second], frame);
  } catch {
    // The library throws for surfaces that are not manifold.
    return null;
  } finally {
    for (const manifold of made) manifold.delete();
  }
}

/** Coordinates of the library: relative to a centre, so that single precision suffices. */
interface Frame {
  readonly centre: readonly [number, number, number];
  readonly extent: number;
}

function frameOf(solids: readonly Solid[]): Frame {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const { points } of solids) {
    points.forEach((x, i) => {
      low[i % 3] = Math.min(low[i % 3] ?? x, x);
      high[i % 3] = Math.max(high[i % 3] ?? x, x);
    });
  }
  const middle = (k: number): number => ((low[k] ?? 0) + (high[k] ?? 0)) / 2;
  const extent = Math.hypot(...high.map((x, k) => x - (low[k] ?? 0)));
  return { centre: [middle(0), middle(1), middle(2)], extent: extent > 0 ? extent : 1 };
}

function manifoldOf(
  library: ManifoldToplevel,
  { points, triangles, trianglePatch }: Solid,
  id: number,
  { centre, extent }: Frame,
): Manifold {
  const mesh = new library.Mesh({
    numProp: 3,
    vertProperties: Float32Array.from(points, (x, i) => (x - (centre[i % 3] ?? 0)) / extent),
    triVerts: triangles,
    faceID: trianglePatch,
    runOriginalID: Uint32Array.of(id),
    runIndex: Uint32Array.of(0, triangles.length),
  });
  return new library.Manifold(mesh);
}

function combinedOf(result: Manifold, firstId: number, solids: readonly Solid[], frame: Frame): Combined {
  const mesh = result.getMesh();
  const { numProp, vertProperties, triVerts, runIndex, runOriginalID, faceID } = mesh;
  const { centre, extent } = frame;
  const count = vertProperties.length / numProp;
  const points = new Float64Array(3 * count);
  for (let i = 0; i < points.length; ++i) {
    const local = vertProperties[numProp * Math.floor(i / 3) + (i % 3)] ?? 0;
    points[i] = local * extent + (centre[i % 3] ?? 0);
  }
  const known = new PointIndex<Position>(nodeTolerance * extent);
  for (const solid of solids) positionsOf(solid.points).forEach((position) => known.add(position, position));
  positionsOf(points).forEach((position, node) => {
    const given = known.find(position);
    if (given) points.set(given, 3 * node);
  });
  const merged = Uint32Array.from({ length: count }, (_, vertex) => vertex);
  mesh.mergeFromVert.forEach((from, i) => (merged[from] = mesh.mergeToVert[i] ?? from));
  const solid = new Uint8Array(triVerts.length / 3);
  for (let run = 0; run < runOriginalID.length; ++run) {
    const which = (runOriginalID[run] ?? firstId) - firstId;
    solid.fill(which, (runIndex[run] ?? 0) / 3, (runIndex[run + 1] ?? triVerts.length) / 3);
  }
  return {
    points,
    triangles: triVerts.map((vertex) => merged[vertex] ?? vertex),
    solid,
    patch: faceID.slice(),
  };
}

const positionsOf = (points: Float64Array): Position[] =>
  Array.from({ length: points.length / 3 }, (_, node) => [
    points[3 * node] ?? 0,
    points[3 * node + 1] ?? 0,
    points[3 * node + 2] ?? 0,
  ]);
