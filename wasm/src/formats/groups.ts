/** Triangles by patch and tetrahedra by region, with names: the groups that other programs assign conditions to. */
import { type Steps, stepwise } from "../base/steps.js";
import type { MeshGroup } from "../mesh/mesh.js";
import type { Note } from "./file-format.js";
import type { WrittenMesh } from "./second-order.js";

/** Gmsh's element types; its node order equals ours. */
export const TRIANGLE = { type: 2, dimension: 2, nodes: 3 } as const;
export const TETRAHEDRON = { type: 4, dimension: 3, nodes: 4 } as const;
/** Second-order elements; Gmsh's order of the last two nodes of the tetrahedron is the opposite of ours. */
export const TRIANGLE6 = { type: 9, dimension: 2, nodes: 6 } as const;
export const TETRAHEDRON10 = { type: 11, dimension: 3, nodes: 10 } as const;
export type ElementKind = typeof TRIANGLE | typeof TETRAHEDRON | typeof TRIANGLE6 | typeof TETRAHEDRON10;

/** Elements of one entity, in the order of the mesh. */
export interface Group {
  readonly kind: ElementKind;
  /** Unique among the groups of its kind, by `fitToFormat`. */
  readonly tag: number;
  /** Unique among the groups of its kind; without quotes and line ends. */
  readonly name: string;
  /** Node indices of all its elements: a part of the mesh's array if they follow each other there, otherwise a copy. */
  readonly nodes: Uint32Array;
}

/** Requirements of a format on names. */
export interface Naming {
  /** Converts a name to permitted characters. Names with different trailing numbers must stay different. */
  readonly toPlain?: (name: string) => string;
  /** Largest number of UTF-8 bytes before `toPlain`; longer names are truncated. */
  readonly maxBytes?: number;
  /** Whether the format ignores the case of letters. */
  readonly isCaseInsensitive?: boolean;
  /** Receives a sentence about names that were changed. */
  readonly note?: Note;
}

/** Returns groups with the given names, or named "word 1", "word 2", …, with tags from 1. */
export function numbered(
  word: string,
  count: number,
  names: readonly (string | undefined)[] = [],
): MeshGroup[] {
  return Array.from({ length: count }, (_, i) => ({ name: names[i] ?? `${word} ${i + 1}`, tag: i + 1 }));
}

/** Numbers names that occur several times, from the second on: "bolt", "bolt 2". Keeps what has no name. O(n). */
export function differentNames<Name extends string | undefined>(names: readonly Name[]): (Name | string)[] {
  const given = new Set<string | undefined>(names);
  const lastOf = new Map<string, number>();
  return names.map((name) => {
    if (name === undefined) return name;
    const last = lastOf.get(name);
    let number = (last ?? 0) + 1;
    while (last !== undefined && given.has(`${name} ${number}`)) number++;
    lastOf.set(name, number);
    return last === undefined ? name : `${name} ${number}`;
  });
}

/**
 * Returns the number of groups that the indices refer to: the largest index plus 1. A loop, because a page counts the
 * regions of millions of elements in one task, and `reduce` takes five times as long.
 */
export function countOf(indices: Uint32Array): number {
  let count = 0;
  for (let i = 0; i < indices.length; i++) count = Math.max(count, (indices[i] ?? 0) + 1);
  return count;
}

/**
 * Returns the indices of the groups that own an element, in ascending order. O(n), and about a hundred times faster
 * than a set built from the owners one by one.
 */
export function usedGroups(owners: Uint32Array, groups: readonly MeshGroup[]): ReadonlySet<number> {
  const isUsed = new Uint8Array(groups.length);
  for (const owner of owners) isUsed[owner] = 1;
  return new Set(groups.flatMap((_, g) => (isUsed[g] === 1 ? [g] : [])));
}

/** Returns the triangles by patch; patches without triangles have no group. O(n). */
export function patchGroups(mesh: WrittenMesh, naming?: Naming): Steps<Group[]> {
  const { triangles, trianglePatch, patches, midNodes } = mesh;
  const kind = midNodes === undefined ? TRIANGLE : TRIANGLE6;
  const elements = { kind, corners: triangles, middles: midNodes?.triangles };
  return groupsOf(elements, trianglePatch, patches, "patch", naming);
}

/** Returns the tetrahedra by region; regions without tetrahedra have no group. O(n). */
export function regionGroups(mesh: WrittenMesh, naming?: Naming): Steps<Group[]> {
  const { tetrahedra, tetrahedronRegion, regions, midNodes } = mesh;
  const kind = midNodes === undefined ? TETRAHEDRON : TETRAHEDRON10;
  const elements = { kind, corners: tetrahedra, middles: midNodes?.tetrahedra };
  return groupsOf(elements, tetrahedronRegion, regions, "region", naming);
}

/** All elements of one dimension: their corners, and the nodes at the middles of their edges, if there are any. */
interface Elements {
  readonly kind: ElementKind;
  readonly corners: Uint32Array;
  readonly middles: Uint32Array | undefined;
}

/** Returns the first element of each owner whose elements follow each other, and how many elements each has. */
function* runsOf(owners: Uint32Array, count: number) {
  const [counts, starts] = [new Uint32Array(count), new Uint32Array(count)];
  const isRun = new Uint8Array(count).fill(1);
  yield* stepwise(owners.length, (e) => {
    const owner = owners[e] ?? 0;
    const before = counts[owner] ?? 0;
    if (before === 0) starts[owner] = e;
    else if ((starts[owner] ?? 0) + before !== e) isRun[owner] = 0;
    counts[owner] = before + 1;
  });
  return { counts, startOf: (owner: number) => (isRun[owner] === 1 ? starts[owner] : undefined) };
}

/** Splits elements by owner; the order is kept. */
function* groupsOf(
  { kind, corners, middles = new Uint32Array() }: Elements,
  owners: Uint32Array,
  groups: readonly MeshGroup[],
  word: string,
  naming: Naming = {},
): Steps<Group[]> {
  const cornerCount = kind.dimension + 1;
  const middleCount = kind.nodes - cornerCount;
  const { counts, startOf } = yield* runsOf(owners, groups.length);
  const runs = Array.from(counts, (count, owner) => {
    const start = middleCount === 0 ? startOf(owner) : undefined;
    return start === undefined
      ? undefined
      : corners.subarray(cornerCount * start, cornerCount * (start + count));
  });
  const split = runs.map((run, owner) => run ?? new Uint32Array(kind.nodes * (counts[owner] ?? 0)));
  const filled = new Uint32Array(groups.length);
  const isCopied = runs.some((run) => run === undefined);
  yield* stepwise(isCopied ? owners.length : 0, (e) => {
    const owner = owners[e] ?? 0;
    const own = split[owner];
    if (own === undefined || runs[owner] !== undefined) return;
    let at = filled[owner] ?? 0;
    for (let i = 0; i < cornerCount; i++) own[at++] = corners[cornerCount * e + i] ?? 0;
    for (let i = 0; i < middleCount; i++) own[at++] = middles[middleCount * e + i] ?? 0;
    filled[owner] = at;
  });
  const taken = new Set<string>();
  const changed: string[] = [];
  const named = split.flatMap((own, owner) => {
    if (own.length === 0) return [];
    const group = groups[owner] ?? { name: "", tag: 0 };
    const name = uniqueName(group.name, `${word} ${owner + 1}`, taken, naming);
    if (name !== group.name && !hasGenericName(group)) changed.push(`"${group.name}" as "${name}"`);
    return [{ kind, tag: group.tag, name, nodes: own }];
  });
  if (changed.length > 0) {
    naming.note?.(
      `names of ${word === "patch" ? "patches" : "regions"} changed to what the format permits: ${listed(changed)}`,
    );
  }
  return named;
}

/** Largest number of names in a message: a mesh may have as many groups as triangles. */
const MAX_LISTED = 10;

/** Joins items for a message: "a, b and 3 more". */
export function listed(items: readonly string[]): string {
  const more = items.length - MAX_LISTED;
  return `${items.slice(0, MAX_LISTED).join(", ")}${more > 0 ? ` and ${more} more` : ""}`;
}

function uniqueName(
  given: string | undefined,
  otherwise: string,
  taken: Set<string>,
  { toPlain = (name) => name, maxBytes = Infinity, isCaseInsensitive = false }: Naming,
): string {
  const own = (given ?? "").replace(/["\r\n]/g, "'").trim();
  const named = (begin: string, end: string): string =>
    toPlain(shortened(begin, maxBytes - utf8.encode(end).length) + end);
  const key = (name: string): string => (isCaseInsensitive ? name.toLowerCase() : name);
  let name = own === "" ? named("", otherwise) : named(own, "");
  for (let copy = 1; taken.has(key(name)); copy++) {
    name = named(own, copy === 1 ? ` (${otherwise})` : ` (${otherwise}) ${copy}`);
  }
  taken.add(key(name));
  return name;
}

const utf8 = new TextEncoder();

/** Returns the longest prefix of a text that fits into the given number of UTF-8 bytes. */
export function shortened(text: string, bytes: number): string {
  if (utf8.encode(text).length <= bytes) return text;
  return text.slice(0, utf8.encodeInto(text, new Uint8Array(bytes)).read).trimEnd();
}

/** Returns whether a group's name carries no more information than its tag. */
export function hasGenericName({ name, tag }: MeshGroup): boolean {
  return (
    ["", "surface", String(tag)].includes(name) || /^(patch|shell|region|boundary|entity) \d+$/.test(name)
  );
}

/** Returns whether a reader of a file without names would give the group the same name. */
export function hasDefaultName(word: "patch" | "region", { name, tag }: MeshGroup): boolean {
  return ["", "surface", String(tag), `${word} ${tag}`].includes(name);
}

/** Reports the names that a format without names drops. `tags`: the numbers written to the file. */
export function noteNames(
  groups: readonly MeshGroup[],
  note: Note,
  numbers = groups.map(({ tag }) => tag),
): void {
  const named = groups.flatMap((group, g) =>
    hasGenericName(group) ? [] : [`${numbers[g]} for "${group.name}"`],
  );
  if (named.length > 0) note(`names are left out; in the file, their numbers are: ${listed(named)}`);
}
