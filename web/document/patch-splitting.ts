import type { ProjectBodyPatch } from "tetrafront";

/** Triangles with patches. */
interface PatchedTriangles {
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
  readonly trianglePatch: Uint32Array;
}

export interface SplitOptions {
  /** Largest angle between neighbouring triangles of a patch, in degrees; 0 in a plane. */
  readonly angle: number;
  /** Index of the only patch to split; null for all. */
  readonly only: number | null;
  /** Id of the first new patch. */
  readonly nextId: number;
  /** Name of the body: a patch with this name has none of its own. */
  readonly bodyName: string;
}

export interface SplitPatches {
  readonly trianglePatch: Uint32Array<ArrayBuffer>;
  readonly patches: readonly ProjectBodyPatch[];
}

/**
 * Splits patches along edges with a larger angle, so that each part is connected. The part with the lowest corner keeps
 * the id of its patch; the others get new ids, in the order of their lowest corners. O(n log n) for n triangles.
 */
export function splitByAngle(
  surface: PatchedTriangles,
  patches: readonly ProjectBodyPatch[],
  options: SplitOptions,
): SplitPatches {
  const parts = connectedParts(surface, options);
  const lowest = lowestCorners(surface, parts);
  const roots = [...lowest.keys()].sort((a, b) => {
    const [p, q] = [surface.trianglePatch[a] ?? 0, surface.trianglePatch[b] ?? 0];
    return p - q || compare(lowest.get(a) ?? [], lowest.get(b) ?? []) || a - b;
  });
  const patchOfRoot = new Map<number, number>();
  const split = namedParts(
    patches,
    roots.map((root) => surface.trianglePatch[root] ?? 0),
    options,
  );
  roots.forEach((root, part) => patchOfRoot.set(root, part));
  const trianglePatch = Uint32Array.from(
    surface.trianglePatch,
    (_, t) => patchOfRoot.get(parts[t] ?? 0) ?? 0,
  );
  return { trianglePatch, patches: split };
}

/** Returns the patches of parts, given the patch that each is a part of. */
function namedParts(
  patches: readonly ProjectBodyPatch[],
  patchOfPart: readonly number[],
  { nextId, bodyName }: SplitOptions,
): ProjectBodyPatch[] {
  const counts = new Map<number, number>();
  for (const patch of patchOfPart) counts.set(patch, (counts.get(patch) ?? 0) + 1);
  const met = new Map<number, number>();
  let id = nextId;
  return patchOfPart.map((patch) => {
    const given = patches[patch] ?? { id: nextId };
    if (counts.get(patch) === 1) return given;
    const ordinal = (met.get(patch) ?? 0) + 1;
    met.set(patch, ordinal);
    const { name } = given;
    const hasOwnName = name !== undefined && name !== bodyName;
    return {
      id: ordinal === 1 ? given.id : id++,
      ...(hasOwnName && { name: `${name} ${ordinal}` }),
    };
  });
}

/** Returns for each triangle the first triangle of its part. */
function connectedParts(surface: PatchedTriangles, { angle, only }: SplitOptions): Uint32Array {
  const { triangles, trianglePatch } = surface;
  const count = triangles.length / 3;
  const parents = Uint32Array.from({ length: count }, (_, t) => t);
  const rootOf = (triangle: number): number => {
    let t = triangle;
    while ((parents[t] ?? t) !== t) {
      parents[t] = parents[parents[t] ?? t] ?? t;
      t = parents[t] ?? t;
    }
    return t;
  };
  const join = (a: number, b: number): void => {
    const [p, q] = [rootOf(a), rootOf(b)];
    parents[Math.max(p, q)] = Math.min(p, q);
  };
  const normals = unitNormals(surface);
  const limit = Math.cos((angle * Math.PI) / 180);
  const isSmooth = (a: number, b: number, isFlipped: boolean): boolean => {
    let cosine = 0;
    for (let k = 0; k < 3; ++k) cosine += (normals[3 * a + k] ?? 0) * (normals[3 * b + k] ?? 0);
    return (isFlipped ? -cosine : cosine) >= limit;
  };
  for (const { a, b, isFlipped } of neighbours(triangles)) {
    const patch = trianglePatch[a];
    if (patch !== trianglePatch[b]) continue;
    if ((only !== null && only !== patch) || isSmooth(a, b, isFlipped)) join(a, b);
  }
  // A patch that stays as it is may consist of several components.
  if (only !== null) joinOthers(trianglePatch, only, join);
  return parents.map((_, t) => rootOf(t));
}

function joinOthers(trianglePatch: Uint32Array, only: number, join: (a: number, b: number) => void): void {
  const first = new Map<number, number>();
  trianglePatch.forEach((patch, t) => {
    if (patch === only) return;
    const known = first.get(patch);
    if (known === undefined) first.set(patch, t);
    else join(known, t);
  });
}

interface Neighbours {
  readonly a: number;
  readonly b: number;
  /** Whether the two triangles have opposite orientations. */
  readonly isFlipped: boolean;
}

/** Returns the pairs of triangles at the edges that have two. */
function neighbours(triangles: Uint32Array): Neighbours[] {
  const nodes = triangles.reduce((most, node) => Math.max(most, node + 1), 0);
  const keys = new Float64Array(triangles.length);
  for (let edge = 0; edge < triangles.length; ++edge) {
    const [from, to] = endsOf(triangles, edge);
    keys[edge] = Math.min(from, to) * nodes + Math.max(from, to);
  }
  const order = Uint32Array.from(keys, (_, edge) => edge).sort((p, q) => (keys[p] ?? 0) - (keys[q] ?? 0));
  const pairs: Neighbours[] = [];
  for (let first = 0; first < order.length;) {
    let end = first + 1;
    while (end < order.length && keys[order[end] ?? 0] === keys[order[first] ?? 0]) ++end;
    const [p = 0, q = 0] = [order[first], order[first + 1]];
    if (end - first === 2) {
      const isFlipped = endsOf(triangles, p)[0] === endsOf(triangles, q)[0];
      pairs.push({ a: Math.floor(p / 3), b: Math.floor(q / 3), isFlipped });
    }
    first = end;
  }
  return pairs;
}

function endsOf(triangles: Uint32Array, edge: number): readonly [number, number] {
  const next = edge % 3 === 2 ? edge - 2 : edge + 1;
  return [triangles[edge] ?? 0, triangles[next] ?? 0];
}

function unitNormals({ points, triangles }: PatchedTriangles): Float64Array {
  const normals = new Float64Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => 3 * (triangles[t + corner] ?? 0)) as [number, number, number];
    const side = (node: number, k: number): number => (points[node + k] ?? 0) - (points[a + k] ?? 0);
    const [ux, uy, uz] = [side(b, 0), side(b, 1), side(b, 2)];
    const [vx, vy, vz] = [side(c, 0), side(c, 1), side(c, 2)];
    const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const norm = Math.hypot(...normal) || 1;
    normal.forEach((part, k) => (normals[t + k] = part / norm));
  }
  return normals;
}

/** Returns the lowest corner of each part, z first. */
function lowestCorners(
  { points, triangles }: PatchedTriangles,
  parts: Uint32Array,
): Map<number, readonly number[]> {
  const lowest = new Map<number, readonly number[]>();
  triangles.forEach((node, corner) => {
    const part = parts[Math.floor(corner / 3)] ?? 0;
    const at = [points[3 * node + 2] ?? 0, points[3 * node + 1] ?? 0, points[3 * node] ?? 0];
    const known = lowest.get(part);
    if (!known || compare(at, known) < 0) lowest.set(part, at);
  });
  return lowest;
}

function compare(a: readonly number[], b: readonly number[]): number {
  for (let k = 0; k < a.length; ++k) if (a[k] !== b[k]) return (a[k] ?? 0) - (b[k] ?? 0);
  return 0;
}

/** Returns the patches of a body after some are merged into the first of them. */
export function mergePatches(
  trianglePatch: Uint32Array,
  patches: readonly ProjectBodyPatch[],
  ids: ReadonlySet<number>,
): SplitPatches {
  const into = patches.findIndex(({ id }) => ids.has(id));
  const isMerged = patches.map(({ id }) => ids.has(id));
  return {
    trianglePatch: Uint32Array.from(trianglePatch, (patch) => (isMerged[patch] ? into : patch)),
    patches,
  };
}
