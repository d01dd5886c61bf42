/** Adapts a mesh to the tags and values that a format can store; reports every change. */
import type { MeshGroup, Mesh } from "../mesh/mesh.js";
import type { Note } from "./file-format.js";
import { hasGenericName, listed, numbered, usedGroups } from "./groups.js";
import type { WrittenMesh } from "./second-order.js";

export interface FormatLimits {
  /** Smallest tag of a group; undefined if the format identifies groups by name or order. */
  readonly minTag?: 0 | 1;
  /** Largest tag of a group; by default the largest signed 32-bit number. */
  readonly maxTag?: number;
  /** Whether patches and regions must not share a tag. Patches keep theirs first. */
  readonly hasSharedTags?: boolean;
  /** Whether the format can store this number of values per node; undefined if it stores none. */
  readonly canHoldData?: (components: number) => boolean;
  /** Whether the format stores values of elements too, with the same numbers of values. */
  readonly hasElementData?: boolean;
}

/** Largest signed 32-bit number. */
const MAX_TAG = 0x7fffffff;

/**
 * Returns the mesh as the format can store it: every group has a unique, permitted tag, and unsupported values
 * are dropped. O(n).
 */
export function fitToFormat(mesh: WrittenMesh, limits: FormatLimits, note: Note): WrittenMesh {
  const { minTag, maxTag = MAX_TAG, hasSharedTags = false, canHoldData, hasElementData = false } = limits;
  const takenByPatches = new Set<number>();
  const settled = (word: "patches" | "regions", groups: readonly MeshGroup[], owners: Uint32Array) => {
    const used = usedGroups(owners, groups);
    const taken = hasSharedTags ? takenByPatches : new Set<number>();
    const tags = usableTags(groups, used, { lowest: minTag ?? 1, highest: maxTag, taken });
    const changed = groups.flatMap(({ tag }, g) =>
      used.has(g) && tags[g] !== tag ? [`${tag} as ${tags[g]}`] : [],
    );
    if (minTag !== undefined && changed.length > 0 && !isNumbered(word, groups)) {
      note(
        `numbers of ${word} changed, because the format requires a different whole number from ${minTag} for each` +
          `${hasSharedTags ? " patch and region" : ""}: ${listed(changed)}`,
      );
    }
    return groups.map((group, g) => ({ ...group, tag: tags[g] ?? 0 }));
  };
  const keptOf = (all: Mesh["nodeData"], canHold: boolean, message: (names: readonly string[]) => string) => {
    const kept = [...all].filter(([, { components }]) => canHold && canHoldData?.(components) === true);
    const left = [...all.keys()].filter((name) => !kept.some(([other]) => other === name));
    if (left.length > 0) note(message(left));
    return new Map(kept);
  };
  const nodeData = keptOf(mesh.nodeData, true, omittedDataMessage);
  const elementData = keptOf(mesh.elementData ?? new Map(), hasElementData, omittedElementDataMessage);
  noteUnwrittenRegions(mesh, note);
  return {
    ...mesh,
    nodeData,
    elementData,
    patches: settled("patches", mesh.patches, mesh.trianglePatch),
    regions: settled("regions", mesh.regions, mesh.tetrahedronRegion),
  };
}

/** Returns whether this program chose all tags, to which nothing refers yet. */
function isNumbered(word: "patches" | "regions", groups: readonly MeshGroup[]): boolean {
  const own = numbered(word === "patches" ? "patch" : "region", groups.length);
  return groups.every(
    ({ name, tag, isTagChosen = false }, g) => isTagChosen || (name === own[g]?.name && tag === own[g].tag),
  );
}

/** Tags that a format permits. */
interface Numbers {
  readonly lowest: number;
  readonly highest: number;
  /** Tags already in use; the assigned ones are added. */
  readonly taken: Set<number>;
}

/** Keeps each group's tag if it is permitted and free; other groups get the lowest free tags. */
function usableTags(
  groups: readonly MeshGroup[],
  used: ReadonlySet<number>,
  { lowest, highest, taken }: Numbers,
): readonly number[] {
  const tags = new Map<number, number>();
  const isUsable = (tag: number) =>
    Number.isInteger(tag) && tag >= lowest && tag <= highest && !taken.has(tag);
  // Groups without elements come last, so that no used group loses its tag to them.
  const order = groups.map((_, g) => g).sort((a, b) => Number(used.has(b)) - Number(used.has(a)) || a - b);
  for (const g of order) {
    const tag = groups[g]?.tag ?? NaN;
    if (!isUsable(tag)) continue;
    taken.add(tag);
    // Adding 0 turns -0 into 0.
    tags.set(g, tag + 0);
  }
  let next = 1;
  for (const g of order) {
    if (tags.has(g)) continue;
    while (taken.has(next)) next++;
    taken.add(next);
    tags.set(g, next);
  }
  return groups.map((_, g) => tags.get(g) ?? 0);
}

/** Message about the named node values that are not written to a file. */
export function omittedDataMessage(names: readonly string[]): string {
  return `values at the nodes are left out: ${listed(names.map((name) => `"${name}"`))}`;
}

const omittedElementDataMessage = (names: readonly string[]) =>
  `values of the elements are left out: ${listed(names.map((name) => `"${name}"`))}`;

/** Reports regions that would be lost with a surface: no supported format can store regions without tetrahedra. */
function noteUnwrittenRegions({ tetrahedra, surfaceRegions }: Mesh, note: Note): void {
  const named = surfaceRegions?.regions.filter((region) => !hasGenericName(region)) ?? [];
  if (tetrahedra.length > 0 || named.length === 0) return;
  note(
    `regions between the triangles are left out, because the format cannot store them: ${listed(named.map(({ name }) => `"${name}"`))}`,
  );
}

/** Reports the named regions of a mesh that is written in a format for surfaces, which has no place for its tetrahedra. */
export function noteLostRegions({ tetrahedronRegion, regions }: Mesh, note: Note): void {
  const used = usedGroups(tetrahedronRegion, regions);
  const named = regions.filter((region, r) => used.has(r) && !hasGenericName(region));
  if (named.length === 0) return;
  const names = listed(named.map(({ name }) => `"${name}"`));
  note(
    `names of regions are left out with the tetrahedra, because the format stores triangles only: ${names}`,
  );
}
