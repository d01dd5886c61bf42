/** Number of triangles that are drawn at every frame even where drawing is slow. */
export const hurriedTriangles = 2000;

export interface PatchTriangles {
  /** x y z per vertex. Patches share none. */
  readonly positions: ArrayLike<number>;
  /** Three vertices per triangle. */
  readonly index: Uint32Array;
  /** First triangle of each patch, and the end. */
  readonly offsets: ArrayLike<number>;
}

/** The coarse triangles of a patch are made again if its share of triangles would change by this factor. */
const maxChange = 2;

/** The coarse triangles of a patch. */
interface CoarsePatch {
  /** Number of coarse triangles / number of all, which was aimed at. */
  readonly share: number;
  /** Its corners, all and the coarse ones, counted from its first vertex. */
  readonly corners: Uint32Array;
  readonly coarse: Uint32Array;
}

/**
 * Makes about `aimed` triangles in the place of more: those between clusters of vertices, each patch for itself (Rossignac
 * and Borrel, 1993). They use the same vertices, so they stay right while these move: those of a patch are made again only
 * if its triangles are others than before, or if the number of all triangles is very different.
 */
export class CoarseTriangles {
  readonly #aimed: number;
  #patches: readonly CoarsePatch[] = [];

  constructor(aimed: number) {
    this.#aimed = aimed;
  }

  /** Returns the vertices of the coarse triangles. */
  of({ positions, index, offsets }: PatchTriangles): Uint32Array {
    const share = this.#aimed / Math.max(1, index.length / 3);
    if (share >= 1) return index;
    const before = this.#patches;
    const patches: CoarsePatch[] = [];
    const all = new Uint32Array(index.length);
    let count = 0;
    for (let patch = 0; patch + 1 < offsets.length; ++patch) {
      const corners = index.subarray(3 * (offsets[patch] ?? 0), 3 * (offsets[patch + 1] ?? 0));
      const first = corners.reduce((low, vertex) => Math.min(low, vertex), corners[0] ?? 0);
      const known = before[patch];
      const made =
        known && isNear(known.share, share) && isShifted(known.corners, corners, first)
          ? known
          : {
              share,
              corners: corners.map((vertex) => vertex - first),
              coarse: coarseOf(positions, corners, share).map((vertex) => vertex - first),
            };
      patches.push(made);
      for (const vertex of made.coarse) all[count++] = vertex + first;
    }
    this.#patches = patches;
    return all.slice(0, count);
  }
}

const isNear = (known: number, share: number): boolean => Math.max(known / share, share / known) < maxChange;

/** Returns whether each corner is a known one, shifted. */
function isShifted(known: Uint32Array, corners: Uint32Array, shift: number): boolean {
  if (known.length !== corners.length) return false;
  for (let i = 0; i < known.length; ++i) if ((known[i] ?? 0) + shift !== corners[i]) return false;
  return true;
}

/** Returns the corners of the coarse triangles of one patch. */
function coarseOf(positions: ArrayLike<number>, corners: Uint32Array, share: number): Uint32Array {
  const coarse = new Uint32Array(corners.length);
  let count = 0;
  const clusterOf = clusters(positions, corners, share);
  const known = new Set<number>();
  for (let corner = 0; corner < corners.length; corner += 3) {
    const [a = 0, b = 0, c = 0] = [0, 1, 2].map((k) => clusterOf(corners[corner + k] ?? 0));
    const [low = 0, middle = 0, high = 0] = [a, b, c].sort((x, y) => x - y);
    const key = (low * positions.length + middle) * positions.length + high;
    if (low === middle || middle === high || known.has(key)) continue;
    known.add(key);
    coarse.set([a, b, c], count);
    count += 3;
  }
  return coarse.slice(0, count);
}

/**
 * Returns a function from a vertex to the one that stands for all near it: of those that are nearest to the same node of a
 * grid, the one nearest to it. The grid reaches from end to end, so that the edges of patches stay where they are.
 */
function clusters(
  positions: ArrayLike<number>,
  corners: Uint32Array,
  share: number,
): (vertex: number) => number {
  const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]]; // prettier-ignore
  for (const vertex of corners) {
    for (let k = 0; k < 3; ++k) {
      const x = positions[3 * vertex + k] ?? 0;
      low[k] = Math.min(low[k] ?? x, x);
      high[k] = Math.max(high[k] ?? x, x);
    }
  }
  const extents = low.map((x, k) => (high[k] ?? x) - x);
  // A square whose diagonal is divided into n parts has about n² triangles. Two parts keep a patch from vanishing.
  const parts = Math.max(2, Math.round(Math.sqrt((share * corners.length) / 3)));
  const cell = Math.hypot(...extents) / parts;
  const counts = extents.map((extent) => Math.max(1, Math.round(extent / cell) || 1));
  const nearest = new Map<number, { readonly vertex: number; readonly square: number }>();
  const nodeOf = new Map<number, number>();
  for (const vertex of corners) {
    if (nodeOf.has(vertex)) continue;
    let [node, square] = [0, 0];
    for (const [k, count] of counts.entries()) {
      const extent = extents[k] ?? 0;
      const at = extent > 0 ? (((positions[3 * vertex + k] ?? 0) - (low[k] ?? 0)) / extent) * count : 0;
      node = node * (parts + 2) + Math.round(at);
      square += ((at - Math.round(at)) * (extent / count)) ** 2;
    }
    nodeOf.set(vertex, node);
    if (square < (nearest.get(node)?.square ?? Infinity)) nearest.set(node, { vertex, square });
  }
  return (vertex) => nearest.get(nodeOf.get(vertex) ?? 0)?.vertex ?? vertex;
}
