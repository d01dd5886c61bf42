/** Transfers the patches and regions of a mesh, with their names, to what was made of it. */
import { noVolume } from "../formats/boundary.js";
import { countOf, numbered } from "../formats/groups.js";
import { NO_ORIGIN, NO_REGION } from "../generated/constants.js";
import type { Mesh, MeshGroup, SurfaceInput } from "../mesh/mesh.js";
import { chainedOrigins } from "./surface-numbers.js";

/** A repaired, refined or remeshed surface. */
interface ChangedTriangles extends Pick<Mesh, "points" | "triangles"> {
  /** Per triangle and per node: its index in the given surface, or `NO_ORIGIN`. */
  readonly origin: Uint32Array;
  readonly nodeOrigin: Uint32Array;
  /** Two per triangle, if given regions were separated; else empty. */
  readonly triangleRegions?: Uint32Array | undefined;
}

/** Returns the patches of a surface; if it has none, one for all triangles. */
export function patchesIn({
  triangles,
  trianglePatch,
  patches = [],
}: Pick<SurfaceInput, "triangles" | "trianglePatch" | "patches">): Pick<Mesh, "trianglePatch" | "patches"> {
  const isNamed = patches.length > 0;
  if (trianglePatch === undefined) {
    const all = new Uint32Array(triangles.length / 3);
    return { trianglePatch: all, patches: isNamed ? patches : [{ name: "surface", tag: 1 }] };
  }
  return { trianglePatch, patches: isNamed ? patches : numbered("patch", countOf(trianglePatch)) };
}

/** Returns a surface with all parts of a mesh. */
export function completeSurface(surface: SurfaceInput): Mesh {
  return { ...surface, ...noVolume(), ...patchesIn(surface) };
}

/**
 * Returns a changed surface with the patches and regions of the given one, and with the indices there of its triangles and
 * nodes, which messages use. Triangles that fill holes form one more patch, the last, named "filled holes".
 */
export function carriedSurface(given: SurfaceInput, changed: ChangedTriangles): Mesh {
  const { points, triangles, origin, nodeOrigin, triangleRegions: known = new Uint32Array() } = changed;
  const { trianglePatch: before, patches: named } = patchesIn(given);
  const added = named.length;
  const trianglePatch = origin.map((from) => (from === NO_ORIGIN ? added : (before[from] ?? 0)));
  const lastTag = named.reduce((most, { tag }) => Math.max(most, tag), 0);
  const filled: MeshGroup = { name: "filled holes", tag: lastTag + 1 };
  const { surfaceRegions, regionPoints, trueFaces, unit } = given;
  const regionsBeside = ({ triangleRegions: beside }: { readonly triangleRegions: Uint32Array }) => {
    if (known.length > 0) return known;
    return new Uint32Array(2 * origin.length).map((_, side) => {
      const from = origin[side >>> 1] ?? NO_ORIGIN;
      return from === NO_ORIGIN ? NO_REGION : (beside[2 * from + (side & 1)] ?? NO_REGION);
    });
  };
  return {
    ...noVolume(),
    points,
    triangles,
    origin: chainedOrigins(given.origin, origin),
    nodeOrigin: chainedOrigins(given.nodeOrigin, nodeOrigin),
    trianglePatch,
    patches: countOf(trianglePatch) > added ? [...named, filled] : named,
    ...(surfaceRegions && {
      surfaceRegions: { ...surfaceRegions, triangleRegions: regionsBeside(surfaceRegions) },
    }),
    ...(regionPoints && { regionPoints }),
    ...(trueFaces && { trueFaces }),
    ...(unit && { unit }),
  };
}
