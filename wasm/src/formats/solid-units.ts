/**
 * Solids of a file that are prepared together, with common sizes, so that the package and the application make the same mesh of
 * one file. Solids that may touch are prepared one by one until it is known which of them do: these become one surface. All
 * others are free, and one surface too.
 */
import { type Box, nearPairs } from "../base/boxes.js";
import { connectedGroups } from "../base/connected-groups.js";
import { NO_REGION } from "../generated/constants.js";
import type { SurfaceRegions, Mesh } from "../mesh/mesh.js";
import { noVolume } from "./boundary.js";

/** A surface whose solids are known. */
export interface SolidsSurface extends Omit<Mesh, "surfaceRegions"> {
  readonly surfaceRegions: SurfaceRegions;
}

/** Some solids of a surface. */
export interface SolidsPart extends SolidsSurface {
  /** Per triangle and per node: its index in the whole surface. */
  readonly wholeTriangles: Uint32Array;
  readonly wholeNodes: Uint32Array;
}

/** Returns whether a box lies inside another one and touches none of its sides. */
export function isWithin(inner: Box, outer: Box): boolean {
  return inner.low.every((x, k) => x > (outer.low[k] ?? x) && (inner.high[k] ?? x) < (outer.high[k] ?? x));
}

/**
 * Returns the solids of a surface in units, by their first ones: each solid that may touch another is one, with those that it
 * shares triangles with; all others are one together. Boxes decide: solids within others do not touch. O(n).
 */
export function solidUnits({ points, triangles, surfaceRegions }: SolidsSurface): number[][] {
  const { regions, triangleRegions } = surfaceRegions;
  const boxes = boxesOf({ points, triangles }, regions.length, triangleRegions);
  const isNear = new Set(
    nearPairs(boxes)
      .filter(([a, b]) => {
        const [one, other] = [boxes[a], boxes[b]];
        return one !== undefined && other !== undefined && !isWithin(one, other) && !isWithin(other, one);
      })
      .flat(),
  );
  const free = regions.flatMap((_, region) => (isNear.has(region) ? [] : [region]));
  const ofFree = free.slice(1).map((region) => [free[0] ?? 0, region] as const);
  return connectedGroups(regions.length, [...sharedPairs(triangleRegions), ...ofFree]);
}

/** Returns the pairs of regions with common triangles. */
export function sharedPairs(triangleRegions: Uint32Array): (readonly [number, number])[] {
  const pairs = new Map<string, readonly [number, number]>();
  for (let side = 0; side < triangleRegions.length; side += 2) {
    const [a, b] = [triangleRegions[side] ?? NO_REGION, triangleRegions[side + 1] ?? NO_REGION];
    if (a === NO_REGION || b === NO_REGION || a === b) continue;
    pairs.set(`${a} ${b}`, [a, b]);
  }
  return [...pairs.values()];
}

/** Returns the box of points. */
export function boxOf(points: Float64Array): Box {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  points.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3] ?? x, x);
    high[i % 3] = Math.max(high[i % 3] ?? x, x);
  });
  return { low, high };
}

function boxesOf(
  { points, triangles }: Pick<Mesh, "points" | "triangles">,
  count: number,
  triangleRegions: Uint32Array,
): Box[] {
  const boxes = Array.from({ length: count }, () => ({
    low: [Infinity, Infinity, Infinity],
    high: [-Infinity, -Infinity, -Infinity],
  }));
  triangleRegions.forEach((region, side) => {
    const box = boxes[region];
    if (box === undefined) return;
    const t = side >>> 1;
    for (const node of triangles.subarray(3 * t, 3 * t + 3)) {
      for (let k = 0; k < 3; k++) {
        const x = points[3 * node + k] ?? 0;
        box.low[k] = Math.min(box.low[k] ?? x, x);
        box.high[k] = Math.max(box.high[k] ?? x, x);
      }
    }
  });
  return boxes;
}

/** Returns these solids of a surface, with the nodes and patches that they use, in the order of the triangles. O(n). */
export function partOfSolids(given: SolidsSurface, solids: readonly number[]): SolidsPart {
  const { regions, triangleRegions: givenSides, areMeshed, maxVolumes } = given.surfaceRegions;
  const indexOf = new Map(solids.map((region, index) => [region, index]));
  const own: number[] = [];
  const sides: number[] = [];
  for (let t = 0; t < given.trianglePatch.length; t++) {
    const beside = [0, 1].map((side) => indexOf.get(givenSides[2 * t + side] ?? NO_REGION));
    if (beside.every((region) => region === undefined)) continue;
    own.push(t);
    for (const region of beside) sides.push(region ?? NO_REGION);
  }
  const { nodes, ...part } = partOfTriangles(given, own);
  return {
    ...noVolume(),
    ...part,
    surfaceRegions: {
      regions: solids.flatMap((region) => regions[region] ?? []),
      triangleRegions: Uint32Array.from(sides),
      ...(areMeshed && { areMeshed }),
      ...(maxVolumes && { maxVolumes: Float64Array.from(solids, (region) => maxVolumes[region] ?? 0) }),
    },
    ...(given.unit && { unit: given.unit }),
    wholeTriangles: Uint32Array.from(own),
    wholeNodes: nodes,
  };
}

/** Returns these triangles with the patches and nodes that they use, and the indices of the nodes in the surface. O(n). */
export function partOfTriangles<Patch>(
  {
    points,
    triangles,
    trianglePatch,
    patches,
  }: Pick<Mesh, "points" | "triangles" | "trianglePatch"> & {
    readonly patches: readonly Patch[];
  },
  own: readonly number[],
) {
  const nodes = new Numbering();
  const usedPatches = new Numbering();
  const corners: number[] = [];
  for (const t of own) for (const node of triangles.subarray(3 * t, 3 * t + 3)) corners.push(nodes.of(node));
  const owners = Uint32Array.from(own, (t) => usedPatches.of(trianglePatch[t] ?? 0));
  return {
    points: Float64Array.from({ length: 3 * nodes.given.length }, (_, i) => {
      return points[3 * (nodes.given[Math.floor(i / 3)] ?? 0) + (i % 3)] ?? 0;
    }),
    triangles: Uint32Array.from(corners),
    trianglePatch: owners,
    patches: usedPatches.given.flatMap((patch) => patches[patch] ?? []),
    nodes: Uint32Array.from(nodes.given),
  };
}

/** Numbers indices in the order in which they first appear. */
class Numbering {
  readonly given: number[] = [];
  readonly #indices = new Map<number, number>();

  of(index: number): number {
    const known = this.#indices.get(index);
    if (known !== undefined) return known;
    this.#indices.set(index, this.given.length);
    return this.given.push(index) - 1;
  }
}

/**
 * Returns surfaces as one; its nodes, patches and regions are those of the first, then of the next. It states the origins of its
 * triangles and nodes if all of them do. O(n).
 */
export function unitedSurfaces(parts: readonly Mesh[]): Mesh {
  const sum = (of: (part: Mesh) => number): number => parts.reduce((all, part) => all + of(part), 0);
  const points = new Float64Array(sum((part) => part.points.length));
  const triangles = new Uint32Array(sum((part) => part.triangles.length));
  const trianglePatch = new Uint32Array(triangles.length / 3);
  const triangleRegions = new Uint32Array(2 * trianglePatch.length).fill(NO_REGION);
  let [node, triangle, patch, region] = [0, 0, 0, 0];
  for (const part of parts) {
    const count = part.trianglePatch.length;
    points.set(part.points, 3 * node);
    triangles.set(
      part.triangles.map((corner) => node + corner),
      3 * triangle,
    );
    trianglePatch.set(
      part.trianglePatch.map((own) => patch + own),
      triangle,
    );
    const sides = part.surfaceRegions?.triangleRegions;
    sides?.forEach((own, side) => {
      if (own !== NO_REGION) triangleRegions[2 * triangle + side] = region + own;
    });
    node += part.points.length / 3;
    triangle += count;
    patch += part.patches.length;
    region += part.surfaceRegions?.regions.length ?? 0;
  }
  const [first] = parts;
  const origin = joinedIndices(parts.map((part) => part.origin));
  const nodeOrigin = joinedIndices(parts.map((part) => part.nodeOrigin));
  return {
    ...noVolume(),
    ...(origin && { origin }),
    ...(nodeOrigin && { nodeOrigin }),
    points,
    triangles,
    trianglePatch,
    patches: parts.flatMap(({ patches }) => patches),
    surfaceRegions: {
      regions: parts.flatMap(({ surfaceRegions }) => surfaceRegions?.regions ?? []),
      triangleRegions,
    },
    ...(first?.unit && { unit: first.unit }),
  };
}

/** Returns lists of indices as one; undefined if one is missing. */
function joinedIndices(lists: readonly (Uint32Array | undefined)[]): Uint32Array | undefined {
  const known = lists.filter((list) => list !== undefined);
  if (known.length < lists.length) return undefined;
  const joined = new Uint32Array(known.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const list of known) {
    joined.set(list, at);
    at += list.length;
  }
  return joined;
}
