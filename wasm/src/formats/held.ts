/** What a format takes of a mesh beside points, elements and names; the rest is told, not lost in silence. */
import type { Note } from "./file-format.js";
import type { FileGroup, FileMesh } from "./file-mesh.js";
import { listed } from "./groups.js";

export interface Held {
  /** The lowest number that it has for a group; undefined where it tells groups apart by names or its own order. */
  readonly lowestTag?: 0 | 1;
}

/** The largest 32-bit number with a sign. */
const MAX_TAG = 0x7fffffff;

/** The mesh as the format takes it: every group with a number of its own that can stand in the file. O(n). */
export function heldOf(mesh: FileMesh, { lowestTag }: Held, note: Note): FileMesh {
  const settled = (word: string, groups: readonly FileGroup[], owners: Uint32Array) => {
    const used = new Set(owners);
    const tags = usableTags(groups, used, lowestTag ?? 1);
    const changed = groups.flatMap(({ tag }, g) =>
      used.has(g) && tags[g] !== tag ? [`${tag} as ${tags[g]}`] : [],
    );
    if (lowestTag !== undefined && changed.length > 0) {
      note(
        `numbers of ${word} are written otherwise, for the format takes whole ones from ${lowestTag} on, each once: ` +
          listed(changed),
      );
    }
    return groups.map((group, g) => ({ ...group, tag: tags[g] ?? 0 }));
  };
  return {
    ...mesh,
    patches: settled("patches", mesh.patches, mesh.trianglePatch),
    regions: settled("regions", mesh.regions, mesh.tetrahedronRegion),
  };
}

/** The groups' own numbers where they can stand in the file; for others the lowest that are free. */
function usableTags(
  groups: readonly FileGroup[],
  used: ReadonlySet<number>,
  lowest: number,
): readonly number[] {
  const taken = new Set<number>();
  const tags = new Map<number, number>();
  const isUsable = (tag: number) =>
    Number.isInteger(tag) && tag >= lowest && tag <= MAX_TAG && !taken.has(tag);
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
