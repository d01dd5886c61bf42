/** What a format takes of a mesh beside points, elements and names; the rest is told, not lost in silence. */
import type { Note } from "./file-format.js";
import type { FileGroup, FileMesh } from "./file-mesh.js";
import { isPlain, listed, usedGroups } from "./groups.js";

export interface Held {
  /** The lowest number that it has for a group; undefined where it tells groups apart by names or its own order. */
  readonly lowestTag?: 0 | 1;
  /** The highest; that of 32 bits with a sign, if not given. */
  readonly highestTag?: number;
  /** Whether patches and regions have their numbers from one set. Those of patches come first. */
  readonly sharesTags?: boolean;
  /** Whether it takes so many numbers per node; undefined where it takes none. */
  readonly takesData?: (components: number) => boolean;
}

/** The largest 32-bit number with a sign. */
const MAX_TAG = 0x7fffffff;

/**
 * The mesh as the format takes it: every group with a number of its own that can stand in the file, and the numbers at
 * nodes that it has a place for. O(n).
 */
export function heldOf(mesh: FileMesh, held: Held, note: Note): FileMesh {
  const { lowestTag, highestTag = MAX_TAG, sharesTags = false, takesData } = held;
  const takenByPatches = new Set<number>();
  const settled = (word: string, groups: readonly FileGroup[], owners: Uint32Array) => {
    const used = usedGroups(owners, groups);
    const taken = sharesTags ? takenByPatches : new Set<number>();
    const tags = usableTags(groups, used, { lowest: lowestTag ?? 1, highest: highestTag, taken });
    const changed = groups.flatMap(({ tag }, g) =>
      used.has(g) && tags[g] !== tag ? [`${tag} as ${tags[g]}`] : [],
    );
    if (lowestTag !== undefined && changed.length > 0) {
      note(
        `numbers of ${word} are written otherwise, for the format takes whole ones from ${lowestTag} on, each once` +
          `${sharesTags ? " among patches and regions" : ""}: ` +
          listed(changed),
      );
    }
    return groups.map((group, g) => ({ ...group, tag: tags[g] ?? 0 }));
  };
  const data = [...mesh.nodeData];
  const kept = data.filter(([, { components }]) => takesData?.(components) === true);
  const left = data.filter((entry) => !kept.includes(entry)).map(([name]) => name);
  if (left.length > 0) note(leftData(left));
  noteSpaces(mesh, note);
  return {
    ...mesh,
    nodeData: new Map(kept),
    patches: settled("patches", mesh.patches, mesh.trianglePatch),
    regions: settled("regions", mesh.regions, mesh.tetrahedronRegion),
  };
}

/** Numbers that a format takes. */
interface Numbers {
  readonly lowest: number;
  readonly highest: number;
  /** Those of others; the ones given are added. */
  readonly taken: Set<number>;
}

/** The groups' own numbers where they can stand in the file; for others the lowest that are free. */
function usableTags(
  groups: readonly FileGroup[],
  used: ReadonlySet<number>,
  { lowest, highest, taken }: Numbers,
): readonly number[] {
  const tags = new Map<number, number>();
  const isUsable = (tag: number) =>
    Number.isInteger(tag) && tag >= lowest && tag <= highest && !taken.has(tag);
  // Groups without elements come last: none of the others gives way to them.
  const order = groups.map((_, g) => g).sort((a, b) => Number(used.has(b)) - Number(used.has(a)) || a - b);
  for (const g of order) {
    const tag = groups[g]?.tag ?? NaN;
    if (!isUsable(tag)) continue;
    taken.add(tag);
    // The zero of no sign.
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

/** What is said of numbers at nodes, by their names, that are not in the file. */
export function leftData(names: readonly string[]): string {
  return `numbers at the nodes are left out: ${listed(names.map((name) => `"${name}"`))}`;
}

/** Only the triangles are written: no format here tells of spaces between them without tetrahedra. */
function noteSpaces({ tetrahedra, surfaceRegions }: FileMesh, note: Note): void {
  const named = surfaceRegions?.regions.filter((region) => !isPlain(region)) ?? [];
  if (tetrahedra.length > 0 || named.length === 0) return;
  note(
    `regions between the triangles have no place in the format and are left out: ${listed(named.map(({ name }) => `"${name}"`))}`,
  );
}
