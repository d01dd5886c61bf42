/** Finds solids of a surface that almost touch: between them stays a gap that is hardly meant. */
import type { TouchingPair } from "./touching-solids.js";
import {
  centroidOf,
  type Corners,
  cornersOf,
  dot,
  lengthOf,
  minus,
  plus,
  pointOf,
  scaled,
  type Vector,
} from "../base/vectors.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { diagonalOf } from "../formats/near-points.js";
import { short } from "../base/short.js";
import type { Mesh } from "../mesh/mesh.js";

/** Largest gap / diagonal of the surface that is reported. */
const NEAR = 1 / 1000;

/** Number of cells of the grid along each axis. */
const CELLS = 32;

/** Number of significant digits of a gap. */
const DIGITS = 3;

interface Solid {
  readonly region: number;
  readonly triangles: readonly number[];
  readonly nodes: ReadonlySet<number>;
  readonly low: Vector;
  readonly high: Vector;
}

interface Gap {
  readonly width: number;
  readonly position: Vector;
}

/**
 * Returns one warning per pair of solids without a common node that are nearer to each other than a thousandth of the
 * diagonal. `touching`: pairs that intersect, which have no gap. Nodes and centroids of triangles are compared with the
 * triangles of the other solid; edges that cross without them are not found.
 */
export function almostTouching(
  given: Mesh,
  touching: readonly Pick<TouchingPair, "regions">[],
): Diagnostic[] {
  const { surfaceRegions, points } = given;
  if (surfaceRegions === undefined) return [];
  const near = NEAR * diagonalOf(points);
  const solids = surfaceRegions.regions.map((_, region) => solidOf(given, region));
  return solids.flatMap((one, i) =>
    solids.slice(i + 1).flatMap((other) => {
      const isTouching = touching.some(({ regions }) => regions[0] === i && regions[1] === other.region);
      if (isTouching || !areBoxesNear(one, other, near) || haveCommonNode(one, other)) return [];
      const gap = narrower(gapFrom(given, one, other, near), gapFrom(given, other, one, near));
      return gap === undefined || gap.width === 0 ? [] : [gapWarning(given, [one.region, other.region], gap)];
    }),
  );
}

function gapWarning({ surfaceRegions }: Mesh, pair: readonly number[], { width, position }: Gap): Diagnostic {
  const names = pair.map((region) => `"${surfaceRegions?.regions[region]?.name ?? ""}"`).join(" and ");
  const text = short(width, DIGITS);
  const message = `The solids ${names} almost touch: a gap of ${text} is left between them, so they share no faces`;
  // Nodes that face each other are further apart where their triangles differ.
  const remedy = `Use \`weld: ${short(2 * width, 2)}\` if they are meant to touch and their triangles match; otherwise move the solids.`;
  return { ...packageDiagnostic("touching-solids", message, remedy, "warning"), position };
}

function solidOf({ points, triangles, surfaceRegions }: Mesh, region: number): Solid {
  const sides = surfaceRegions?.triangleRegions ?? new Uint32Array();
  const own: number[] = [];
  const nodes = new Set<number>();
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let t = 0; t < triangles.length / 3; t++) {
    if (sides[2 * t] !== region && sides[2 * t + 1] !== region) continue;
    own.push(t);
    for (const node of triangles.subarray(3 * t, 3 * t + 3)) {
      nodes.add(node);
      pointOf(points, node).forEach((x, k) => {
        low[k] = Math.min(low[k] ?? x, x);
        high[k] = Math.max(high[k] ?? x, x);
      });
    }
  }
  return { region, triangles: own, nodes, low, high };
}

function areBoxesNear(one: Solid, other: Solid, near: number): boolean {
  return one.low.every(
    (low, k) => low - near <= (other.high[k] ?? 0) && (other.low[k] ?? 0) - near <= (one.high[k] ?? 0),
  );
}

function haveCommonNode(one: Solid, other: Solid): boolean {
  return [...one.nodes].some((node) => other.nodes.has(node));
}

function narrower(one: Gap | undefined, other: Gap | undefined): Gap | undefined {
  if (one === undefined || other === undefined) return one ?? other;
  return one.width <= other.width ? one : other;
}

/** Returns the smallest distance of nodes and centroids of a solid from the triangles of another one, if it is at most `near`. */
function gapFrom(given: Mesh, from: Solid, to: Solid, near: number): Gap | undefined {
  const { points } = given;
  const low = from.low.map((x, k) => Math.max(x, to.low[k] ?? x) - 2 * near);
  const high = from.high.map((x, k) => Math.min(x, to.high[k] ?? x) + 2 * near);
  const isInside = (p: Vector) => p.every((x, k) => x >= (low[k] ?? 0) && x <= (high[k] ?? 0));
  const cell = (x: number, k: number) => {
    const share = (x - (low[k] ?? 0)) / ((high[k] ?? 0) - (low[k] ?? 0));
    return Math.max(0, Math.min(CELLS - 1, Math.floor(CELLS * share)));
  };
  const cells = new Map<number, number[]>();
  for (const t of to.triangles) {
    const p = cornersOf(given, t);
    const range = [0, 1, 2].map((k) => {
      const all = p.map((corner) => corner[k] ?? 0);
      return [Math.min(...all) - near, Math.max(...all) + near] as const;
    });
    if (range.some(([a, b], k) => b < (low[k] ?? 0) || a > (high[k] ?? 0))) continue;
    const [x, y, z] = range.map(([a, b], k) => [cell(a, k), cell(b, k)] as const);
    if (x === undefined || y === undefined || z === undefined) continue;
    for (let i = x[0]; i <= x[1]; i++) {
      for (let j = y[0]; j <= y[1]; j++) {
        for (let k = z[0]; k <= z[1]; k++) {
          const key = (i * CELLS + j) * CELLS + k;
          const known = cells.get(key);
          if (known === undefined) cells.set(key, [t]);
          else known.push(t);
        }
      }
    }
  }
  let best: Gap | undefined;
  const visit = (position: Vector) => {
    if (!isInside(position)) return;
    const [i = 0, j = 0, k = 0] = position.map(cell);
    for (const t of cells.get((i * CELLS + j) * CELLS + k) ?? []) {
      const width = distanceFrom(position, cornersOf(given, t));
      if (width <= (best?.width ?? near)) best = { width, position };
    }
  };
  for (const node of from.nodes) visit(pointOf(points, node));
  for (const t of from.triangles) visit(centroidOf(cornersOf(given, t)));
  return best;
}

/** Returns the distance of a position from a triangle: from its plane above its inside, else from the nearest edge. */
function distanceFrom(p: Vector, [a, b, c]: Corners): number {
  const [u, v, w] = [minus(b, a), minus(c, a), minus(p, a)];
  const [uu, uv, vv, wu, wv] = [dot(u, u), dot(u, v), dot(v, v), dot(w, u), dot(w, v)];
  const determinant = uu * vv - uv * uv;
  const [s, t] = [(wu * vv - wv * uv) / determinant, (wv * uu - wu * uv) / determinant];
  if (determinant > 0 && s >= 0 && t >= 0 && s + t <= 1) {
    return lengthOf(minus(w, plus(scaled(u, s), scaled(v, t))));
  }
  return Math.min(distanceFromEdge(p, a, b), distanceFromEdge(p, b, c), distanceFromEdge(p, c, a));
}

function distanceFromEdge(p: Vector, a: Vector, b: Vector): number {
  const [along, from] = [minus(b, a), minus(p, a)];
  const squared = dot(along, along);
  const share = squared > 0 ? Math.max(0, Math.min(1, dot(from, along) / squared)) : 0;
  return lengthOf(minus(from, scaled(along, share)));
}
