/** Triangles and nodes of a surface that was made of another, by the numbers that they have in that one. */
import { type EntityNamer, nameByIndex } from "../diagnostics/entity-names.js";
import type { SurfaceInput } from "../mesh/mesh.js";

/** In `SurfaceInput.origin` and `nodeOrigin`: a triangle, or node, that the given surface did not have. */
export const NO_ORIGIN = 0xffffffff;

/**
 * Names triangles and nodes by what they were or are a part of, where the surface tells; the triangles of filled holes,
 * and the nodes within divided edges, were in no other.
 */
export function surfaceNamer({ origin, nodeOrigin }: SurfaceInput): EntityNamer {
  return (kind, index) => {
    const origins = kind === "triangle" ? origin : kind === "surface-node" ? nodeOrigin : undefined;
    if (origins === undefined) return nameByIndex(kind, index);
    const given = origins[index] ?? NO_ORIGIN;
    if (given !== NO_ORIGIN) return nameByIndex(kind, given);
    return { kind, index, label: kind === "triangle" ? `filled triangle ${index}` : `new node ${index}` };
  };
}

/** Origins of things that were all there before: of `given` ones those that stay, in their order, then `added` new ones. */
export function originsOf(given: number, isGone: (index: number) => boolean, added: number): Uint32Array {
  const kept: number[] = [];
  for (let i = 0; i < given; i++) if (!isGone(i)) kept.push(i);
  const all = new Uint32Array(kept.length + added).fill(NO_ORIGIN);
  all.set(kept);
  return all;
}

/** What became of `origins` in two steps; without the first they are those of the second. */
export function chainedOrigins(first: Uint32Array | undefined, second: Uint32Array): Uint32Array {
  return second.map((from) => (from === NO_ORIGIN ? from : (first?.[from] ?? from)));
}
