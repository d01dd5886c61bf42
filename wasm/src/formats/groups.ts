/** Triangles by patch and tetrahedra by region, with names: what other programs put conditions on. */
import type { Note } from "./file-format.js";
import type { FileGroup, FileMesh } from "./file-mesh.js";
import { stepwise, type Steps } from "./steps.js";

/** With Gmsh's numbers of element types; its node order is ours. */
export const TRIANGLE = { type: 2, dimension: 2, nodes: 3 } as const;
export const TETRAHEDRON = { type: 4, dimension: 3, nodes: 4 } as const;
export type ElementKind = typeof TRIANGLE | typeof TETRAHEDRON;

/** Elements of one entity, in the order of the mesh. */
export interface Group {
  readonly kind: ElementKind;
  /** As `heldOf` leaves it: the only one of its kind with it. */
  readonly tag: number;
  /** The only one of its kind with it; without quotes and line ends. */
  readonly name: string;
  /** Node positions of all its elements. */
  readonly nodes: Uint32Array;
}

/** What a format asks of names. */
export interface Naming {
  /** Writes a name as the format can; never the same for two names that end in different numbers. */
  readonly plain?: (name: string) => string;
  /** In bytes of UTF-8, before `plain`: longer names lose their ends. */
  readonly longest?: number;
  /** Whether capitals and small letters are the same to it. */
  readonly isCaseless?: boolean;
  /** Is told of names that are written otherwise than they were given. */
  readonly note?: Note;
}

/**
 * The positions of groups that own an element, in order. O(n), and some hundred times faster than a set made of the
 * owners, one by one.
 */
export function usedGroups(owners: Uint32Array, groups: readonly FileGroup[]): ReadonlySet<number> {
  const isUsed = new Uint8Array(groups.length);
  for (const owner of owners) isUsed[owner] = 1;
  return new Set(groups.flatMap((_, g) => (isUsed[g] === 1 ? [g] : [])));
}

/** The triangles by patch; patches without triangles get no group. O(n). */
export function patchGroups(mesh: FileMesh, naming?: Naming): Steps<Group[]> {
  return groupsOf(TRIANGLE, mesh.triangles, mesh.trianglePatch, mesh.patches, "patch", naming);
}

/** The tetrahedra by region, as `patchGroups`. */
export function regionGroups(mesh: FileMesh, naming?: Naming): Steps<Group[]> {
  return groupsOf(TETRAHEDRON, mesh.tetrahedra, mesh.tetrahedronRegion, mesh.regions, "region", naming);
}

/** Splits elements by owner, keeping their order. */
function* groupsOf(
  kind: ElementKind,
  nodes: Uint32Array,
  owners: Uint32Array,
  groups: readonly FileGroup[],
  word: string,
  naming: Naming = {},
): Steps<Group[]> {
  const counts = new Uint32Array(groups.length);
  const ownerOf = (e: number) => owners[e] ?? 0;
  yield* stepwise(owners.length, (e) => (counts[ownerOf(e)] = (counts[ownerOf(e)] ?? 0) + 1));
  const split = Array.from(counts, (count) => new Uint32Array(kind.nodes * count));
  const filled = new Uint32Array(groups.length);
  yield* stepwise(owners.length, (e) => {
    const own = split[ownerOf(e)];
    let at = filled[ownerOf(e)] ?? 0;
    if (own) for (let i = 0; i < kind.nodes; i++) own[at++] = nodes[kind.nodes * e + i] ?? 0;
    filled[ownerOf(e)] = at;
  });
  const taken = new Set<string>();
  const changed: string[] = [];
  const named = split.flatMap((own, owner) => {
    if (own.length === 0) return [];
    const group = groups[owner] ?? { name: "", tag: 0 };
    const name = uniqueName(group.name, `${word} ${owner + 1}`, taken, naming);
    if (name !== group.name && !isPlain(group)) changed.push(`"${group.name}" as "${name}"`);
    return [{ kind, tag: group.tag, name, nodes: own }];
  });
  if (changed.length > 0) {
    naming.note?.(
      `names of ${word === "patch" ? "patches" : "regions"} are written as the format takes them: ${listed(changed)}`,
    );
  }
  return named;
}

/** In a note no more than these are named: a mesh may have as many groups as triangles. */
const MOST_NAMED = 10;

/** "a, b and 3 more". */
export function listed(items: readonly string[]): string {
  const more = items.length - MOST_NAMED;
  return `${items.slice(0, MOST_NAMED).join(", ")}${more > 0 ? ` and ${more} more` : ""}`;
}

function uniqueName(
  given: string | undefined,
  otherwise: string,
  taken: Set<string>,
  { plain = (name) => name, longest = Infinity, isCaseless = false }: Naming,
): string {
  const own = (given ?? "").replace(/["\r\n]/g, "'").trim();
  const named = (begin: string, end: string): string =>
    plain(shortened(begin, longest - utf8.encode(end).length) + end);
  const key = (name: string): string => (isCaseless ? name.toLowerCase() : name);
  let name = own === "" ? named("", otherwise) : named(own, "");
  for (let copy = 1; taken.has(key(name)); copy++) {
    name = named(own, copy === 1 ? ` (${otherwise})` : ` (${otherwise}) ${copy}`);
  }
  taken.add(key(name));
  return name;
}

const utf8 = new TextEncoder();

/** As much of a text as fits into so many bytes, without half characters. */
export function shortened(text: string, bytes: number): string {
  if (utf8.encode(text).length <= bytes) return text;
  return text.slice(0, utf8.encodeInto(text, new Uint8Array(bytes)).read).trimEnd();
}

/** A name that says no more than the number does. */
export function isPlain({ name, tag }: FileGroup): boolean {
  return (
    ["", "surface", String(tag)].includes(name) || /^(patch|shell|region|boundary|entity) \d+$/.test(name)
  );
}

/** For formats without a place for names. `numbers`: what the file has instead. */
export function noteNames(
  groups: readonly FileGroup[],
  note: Note,
  numbers = groups.map(({ tag }) => tag),
): void {
  const named = groups.flatMap((group, g) => (isPlain(group) ? [] : [`${numbers[g]} for "${group.name}"`]));
  if (named.length > 0) note(`names are left out, their numbers stand for them: ${listed(named)}`);
}
