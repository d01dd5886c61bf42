/** Patches into which a surface is split, and their names. */
import { hasGenericName } from "../formats/groups.js";
import { type MeshGroup, isColorName, type Mesh } from "../mesh/mesh.js";

/** Pieces of patches, ordered by position. */
interface PatchPieces {
  /** Per triangle: index of its piece. */
  readonly trianglePatch: Uint32Array;
  /** Per piece: index of its given patch. */
  readonly patchGroup: Uint32Array;
}

/** Returns the patches of a split surface. `split`: indices of the given patches that are split; default all. O(n). */
export function splitSurface(
  pieces: PatchPieces,
  given: readonly MeshGroup[],
  split?: readonly number[],
): Pick<Mesh, "trianglePatch" | "patches"> {
  const chosen = split && new Set(split);
  const isSplit = (group: number): boolean => chosen?.has(group) ?? true;
  const { trianglePatch, patchGroup } = chosen ? withWholePatches(pieces, isSplit) : pieces;
  return { trianglePatch, patches: splitGroups(patchGroup, given, isSplit) };
}

/** Joins the pieces of each patch that is not split, in the slot of its first piece. */
function withWholePatches(
  { trianglePatch, patchGroup }: PatchPieces,
  isSplit: (group: number) => boolean,
): PatchPieces {
  const whole = new Map<number, number>();
  const groups: number[] = [];
  const newIndex = patchGroup.map((group) => {
    const known = whole.get(group);
    if (known !== undefined) return known;
    if (!isSplit(group)) whole.set(group, groups.length);
    return groups.push(group) - 1;
  });
  return {
    trianglePatch: trianglePatch.map((piece) => newIndex[piece] ?? 0),
    patchGroup: Uint32Array.from(groups),
  };
}

/**
 * Returns the patches of a split surface, which are ordered by position. `patchGroup`: per patch, the index of the given
 * patch of which it is a piece. Pieces of a named patch are called "wing", "wing 2", …, all others "patch 1", "patch 2", …,
 * also those of an only patch that is named after its colour. The first piece of a named patch keeps its number, the others
 * get free ones. A patch that is not split stays as given.
 */
export function splitGroups(
  patchGroup: Uint32Array,
  given: readonly MeshGroup[],
  isSplit: (group: number) => boolean = () => true,
): MeshGroup[] {
  const pieces = new Uint32Array(patchGroup.reduce((most, group) => Math.max(most, group + 1), 0));
  for (const group of patchGroup) pieces[group] = (pieces[group] ?? 0) + 1;
  const isUnnamed = (group: MeshGroup): boolean =>
    hasGenericName(group) || (given.length === 1 && isColorName(group.name));
  const named = (index: number): MeshGroup | undefined => {
    const group = given[index];
    return group === undefined || (isSplit(index) && isUnnamed(group)) ? undefined : group;
  };
  const kept = [...new Set(patchGroup)].flatMap((index) => named(index) ?? []);
  const freeName = freeNames(kept.map(({ name }) => name));
  const tags = new Set(kept.map(({ tag }) => tag));
  const taken = new Set<number>();
  let lastTag = 0;
  return Array.from(patchGroup, (index) => {
    const group = named(index);
    if (group !== undefined && !taken.has(index)) {
      taken.add(index);
      return pieces[index] === 1 ? group : { name: group.name, tag: group.tag };
    }
    do lastTag++;
    while (tags.has(lastTag));
    const name = group === undefined ? freeName("patch", 1) : freeName(group.name, 2);
    return { name, tag: lastTag };
  });
}

/** Returns a function that appends to a name the next number, from `first` on, with which it is free. */
function freeNames(taken: readonly string[]): (name: string, first: number) => string {
  const names = new Set(taken);
  const last = new Map<string, number>();
  return (name, first) => {
    let number = last.get(name) ?? first - 1;
    do number++;
    while (names.has(`${name} ${number}`));
    last.set(name, number);
    const free = `${name} ${number}`;
    names.add(free);
    return free;
  };
}
