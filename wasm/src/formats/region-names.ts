/**
 * Transfers the regions of a file to the mesh generated inside its triangles: each new region becomes the file's
 * region next to most of its triangles.
 */
import { type Steps, stepwise } from "../base/steps.js";
import type { MeshGroup, Mesh, SurfaceRegions } from "../mesh/mesh.js";
import { NO_REGION } from "../generated/constants.js";
import { hasGenericName } from "./groups.js";
import { NONE, tetFaces } from "./tet-faces.js";

/**
 * Returns the regions on the sides of the triangles, from the file's volumes or else its tetrahedra; undefined if
 * the file has neither. O(n) expected.
 */
export function* surfaceRegionsOf(mesh: Mesh): Steps<SurfaceRegions | undefined> {
  const { regions, tetrahedronRegion, surfaceRegions } = mesh;
  if (mesh.tetrahedra.length === 0) return surfaceRegions;
  if (regions.length === 1 && regions.every(hasGenericName)) return undefined;
  const { faceOfTriangle, twin } = yield* tetFaces(mesh);
  const regionAt = (face: number) =>
    face === NONE ? NO_REGION : (tetrahedronRegion[face >>> 2] ?? NO_REGION);
  const triangleRegions = new Uint32Array(2 * faceOfTriangle.length);
  yield* stepwise(faceOfTriangle.length, (t) => {
    const face = faceOfTriangle[t] ?? NONE;
    triangleRegions[2 * t] = regionAt(face);
    triangleRegions[2 * t + 1] = regionAt(face === NONE ? NONE : (twin[face] ?? NONE));
  });
  return { regions, triangleRegions };
}

/** Regions with names, and per region of a run the index of that which it is, or is a part of. */
export interface NamedRegions {
  readonly regions: readonly MeshGroup[];
  readonly indices: readonly number[];
}

/** Returns the regions of a mesh generated from the surface, with the tags and names of their matches. */
export function carriedRegions(
  triangleRegions: Uint32Array,
  given: SurfaceRegions,
  count: number,
): NamedRegions {
  const found = matches(triangleRegions, given, count);
  const used = [...new Set(found)].filter((region) => region !== NO_REGION).sort((a, b) => a - b);
  // Several volumes of a file may be one region: they have the same tag and name.
  const isSame = (one: MeshGroup | undefined, other: MeshGroup | undefined) =>
    one?.tag === other?.tag && one?.name === other?.name;
  const groups = used.flatMap((region) => given.regions[region] ?? []);
  const regions = groups.filter((group, g) => groups.findIndex((other) => isSame(group, other)) === g);
  const lastTag = regions.reduce((most, { tag }) => Math.max(most, tag), 0);
  let added = 0;
  const indices = found.map((region, own) => {
    if (region !== NO_REGION) return regions.findIndex((group) => isSame(group, given.regions[region]));
    regions.push({ name: `region ${own + 1}`, tag: lastTag + ++added, isTagChosen: true });
    return regions.length - 1;
  });
  return { regions, indices };
}

/** Triangles with the same regions on their sides, in the mesh and in the file. */
interface Interface {
  readonly own: readonly number[];
  readonly theirs: readonly number[];
  triangles: number;
}

/** Returns one entry per pair of touching regions, however many triangles they share. */
function interfacesOf(sides: Uint32Array, given: Uint32Array): Interface[] {
  const found = new Map<string, Interface>();
  let [last, lastSide]: [Interface | undefined, number] = [undefined, 0];
  for (let side = 0; side < sides.length; side += 2) {
    const isLast = [0, 1].every(
      (k) => sides[side + k] === sides[lastSide + k] && given[side + k] === given[lastSide + k],
    );
    if (last === undefined || !isLast) {
      const [own, theirs] = [sides, given].map((all) => [...all.subarray(side, side + 2)]);
      const key = `${own?.join()} ${theirs?.join()}`;
      last = found.get(key) ?? {
        own: own?.filter(isRegion) ?? [],
        theirs: theirs?.filter(isRegion) ?? [],
        triangles: 0,
      };
      found.set(key, last);
      lastSide = side;
    }
    last.triangles++;
  }
  return [...found.values()];
}

/** Returns the matching region of the file per region of the mesh, or NO_REGION. */
function matches(sides: Uint32Array, given: SurfaceRegions, count: number): number[] {
  const found = Array.from({ length: count }, () => NO_REGION);
  let open = interfacesOf(sides, given.triangleRegions);
  // Repeat: a match on one side of an interface determines the region on the other side.
  for (let isChanged = true; isChanged;) {
    const votes = new Map<number, Map<number, number>>();
    open = open.filter(({ own }) => own.some((region) => found[region] === NO_REGION));
    for (const { own, theirs, triangles } of open) {
      const [region, match] = onlyPair(own, theirs, found);
      if (region === undefined || match === undefined) continue;
      const tally = votes.get(region) ?? new Map<number, number>();
      votes.set(region, tally.set(match, (tally.get(match) ?? 0) + triangles));
    }
    isChanged = votes.size > 0;
    votes.forEach((tally, region) => {
      const largest = Math.max(...tally.values());
      const best = [...tally].filter(([, number]) => number === largest).map(([match]) => match);
      found[region] = Math.min(...best);
    });
  }
  return found;
}

const isRegion = (region: number | undefined): region is number =>
  region !== undefined && region !== NO_REGION;

/**
 * Returns the only unmatched region of the mesh at an interface and its only candidate; empty if they are not
 * unique.
 */
function onlyPair(
  own: readonly number[],
  theirs: readonly number[],
  found: readonly number[],
): readonly [] | readonly [number, number] {
  const left = [...theirs];
  const open = own.filter((region) => {
    const slot = left.indexOf(found[region] ?? NO_REGION);
    if (slot >= 0) left.splice(slot, 1);
    return found[region] === NO_REGION;
  });
  const [region, match] = [open[0], left[0]];
  const isClear = open.length === 1 && left.length === 1 && own.length === theirs.length;
  return isClear && region !== undefined && match !== undefined ? [region, match] : [];
}
