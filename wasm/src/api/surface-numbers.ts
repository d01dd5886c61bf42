/** Maps the triangles and nodes of a repaired, refined or remeshed surface to their indices in the given one. */
import { type EntityNamer, nameByIndex } from "../diagnostics/entity-names.js";
import { NO_ORIGIN } from "../generated/constants.js";
import type { MeshedRegions } from "../engine/protocol.js";
import type { SurfaceInput } from "../mesh/mesh.js";

/**
 * Names triangles and nodes by their indices in the given surface, if the surface states them. Triangles of filled
 * holes, midpoints of split edges and nodes of a remeshed surface have no index there; they are called "filled triangle
 * 7" and "new node 7".
 */
export function surfaceNamer({
  origin,
  nodeOrigin,
}: Pick<SurfaceInput, "origin" | "nodeOrigin">): EntityNamer {
  return (kind, index) => {
    const origins = kind === "triangle" ? origin : kind === "surface-node" ? nodeOrigin : undefined;
    if (origins === undefined) return nameByIndex(kind, index);
    const given = origins[index] ?? NO_ORIGIN;
    if (given !== NO_ORIGIN) return nameByIndex(kind, given);
    return { kind, index, label: kind === "triangle" ? `filled triangle ${index}` : `new node ${index}` };
  };
}

/** Returns a copy of the regions that are meshed, for the engine; empty if they are not known. */
export function meshedRegionsOf({ surfaceRegions }: SurfaceInput): MeshedRegions {
  const { triangleRegions, maxVolumes } = (surfaceRegions?.areMeshed === true && surfaceRegions) || {};
  return {
    triangleRegions: triangleRegions?.slice() ?? new Uint32Array(),
    maxVolumes: maxVolumes?.slice() ?? new Float64Array(),
  };
}

export function triangleRegionsOf(surface: SurfaceInput): Uint32Array {
  return meshedRegionsOf(surface).triangleRegions;
}

/**
 * Returns the origin of each item after a change: the indices below `given` of the items that are not gone, in
 * order, then `NO_ORIGIN` for `added` new ones.
 */
export function originsOf(given: number, isGone: (index: number) => boolean, added: number): Uint32Array {
  const kept: number[] = [];
  for (let i = 0; i < given; i++) if (!isGone(i)) kept.push(i);
  const all = new Uint32Array(kept.length + added).fill(NO_ORIGIN);
  all.set(kept);
  return all;
}

/** Composes the origins of two successive changes; if `first` is undefined, returns those of the second. */
export function chainedOrigins(first: Uint32Array | undefined, second: Uint32Array): Uint32Array {
  return second.map((from) => (from === NO_ORIGIN ? from : (first?.[from] ?? from)));
}
