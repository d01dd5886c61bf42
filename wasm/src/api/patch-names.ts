/** Names of the patches into which a surface is split. */
import { hasGenericName } from "../formats/groups.js";
import type { FileGroup } from "../mesh/file-mesh.js";

/**
 * Returns the patches of a split surface, which are ordered by position. `patchGroup`: per patch, the index of the given
 * patch of which it is a piece. Pieces of a named patch are called "wing", "wing 2", …, all others "patch 1", "patch 2", ….
 * The first piece of a named patch keeps its number, the others get free ones.
 */
export function splitGroups(patchGroup: Uint32Array, given: readonly FileGroup[]): FileGroup[] {
  const pieces = new Uint32Array(patchGroup.reduce((most, group) => Math.max(most, group + 1), 0));
  for (const group of patchGroup) pieces[group] = (pieces[group] ?? 0) + 1;
  const named = (index: number): FileGroup | undefined => {
    const group = given[index];
    return group === undefined || hasGenericName(group) ? undefined : group;
  };
  const kept = [...new Set(patchGroup)].flatMap((index) => named(index) ?? []);
  const names = new Set(kept.map(({ name }) => name));
  const tags = new Set(kept.map(({ tag }) => tag));
  const taken = new Set<number>();
  let patches = 0;
  let lastTag = 0;
  return Array.from(patchGroup, (index) => {
    const group = named(index);
    if (group !== undefined && !taken.has(index)) {
      taken.add(index);
      return pieces[index] === 1 ? group : { name: group.name, tag: group.tag };
    }
    do lastTag++;
    while (tags.has(lastTag));
    if (group === undefined) return { name: `patch ${++patches}`, tag: lastTag };
    return { name: freeName(group.name, names), tag: lastTag };
  });
}

/** Returns the name with the first free number from 2 on, and reserves it. */
function freeName(name: string, names: Set<string>): string {
  let number = 2;
  while (names.has(`${name} ${number}`)) number++;
  const free = `${name} ${number}`;
  names.add(free);
  return free;
}
