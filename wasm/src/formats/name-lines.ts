/**
 * Names of patches and regions as lines of text: "patch 4 inlet". Formats that know numbers alone keep them where they
 * have a place for any text, such as comments, which other programs pass over.
 */
import type { Note } from "./file-format.js";
import type { FileGroup, FileMesh } from "./file-mesh.js";
import { isPlain, listed, shortened, usedGroups } from "./groups.js";
import { GroupList } from "./mesh-builder.js";

/** In bytes: no line is longer than readers of comments look at. */
const LONGEST = 500;

/**
 * One line per group with elements whose name says more than its number; without line ends. Of a group without any, a
 * reader would take the name for that of another.
 */
export function nameLines(word: "patch" | "region", mesh: FileMesh, note: Note): string[] {
  const [groups, owners] =
    word === "patch" ? [mesh.patches, mesh.trianglePatch] : [mesh.regions, mesh.tetrahedronRegion];
  const used = usedGroups(owners, groups);
  const cut: string[] = [];
  const lines = groups.flatMap((group, g) => {
    if (isPlain(group) || !used.has(g)) return [];
    const whole = `${word} ${group.tag} ${group.name.replace(/\s+/g, " ").trim()}`;
    const line = shortened(whole, LONGEST);
    if (line !== whole) cut.push(`that of ${word} ${group.tag}`);
    return [line];
  });
  if (cut.length > 0) note(`names too long for a comment's line of ${LONGEST} bytes are cut: ${listed(cut)}`);
  return lines;
}

/** The lines of patches and regions. */
export function allNameLines(mesh: FileMesh, note: Note): string[] {
  return [...nameLines("patch", mesh, note), ...nameLines("region", mesh, note)];
}

/** The names that a file tells in such lines; all other lines are passed over. */
export class NameLines {
  readonly patches = new Map<number, string>();
  readonly regions = new Map<number, string>();

  readonly hear: (line: string) => void = (line) => this.hearName(line);

  protected hearName(line: string): void {
    const [, word, tag, name = ""] = /^\s*(patch|region) (\d+) (.*\S)\s*$/.exec(line) ?? [];
    if (word !== undefined) (word === "patch" ? this.patches : this.regions).set(Number(tag), name);
  }

  /** A mesh with the names; where both have but one patch, that is meant. */
  given(mesh: FileMesh): FileMesh {
    const { patches, regions } = mesh;
    const [only, ...others] = this.patches;
    const isOne = only !== undefined && others.length === 0 && patches.length === 1;
    const named = (groups: readonly FileGroup[], names: ReadonlyMap<number, string>) =>
      groups.map((group) => ({ ...group, name: names.get(group.tag) ?? group.name }));
    return {
      ...mesh,
      patches: isOne ? [{ ...patches[0], tag: only[0], name: only[1] }] : named(patches, this.patches),
      regions: named(regions, this.regions),
    };
  }
}

/** Between lines where a format has but one line for all. */
export const NAME_BREAK = "; ";

export const STL_TITLE = "binary STL";
/** Begins a header of STL that tells the patches by name, in the order of their numbers. */
export const STL_NAMES = `${STL_TITLE}: `;

/** So many ranges of faces are in one line. */
const RANGES_PER_LINE = 100;

/** "faces of patch 4: 0-11 20-20", for formats that say nothing of their faces; none where there is one patch. */
export function faceLines(owners: Uint32Array, groups: readonly FileGroup[]): string[] {
  if (groups.length < 2) return [];
  const ranges = groups.map((): string[] => []);
  for (let begin = 0, end = 0; begin < owners.length; begin = end) {
    while (end < owners.length && owners[end] === owners[begin]) end++;
    ranges[owners[begin] ?? 0]?.push(`${begin}-${end - 1}`);
  }
  return ranges.flatMap((own, group) => {
    const lines: string[] = [];
    for (let i = 0; i < own.length; i += RANGES_PER_LINE) {
      lines.push(`faces of patch ${groups[group]?.tag ?? 0}: ${own.slice(i, i + RANGES_PER_LINE).join(" ")}`);
    }
    return lines;
  });
}

/** Hears the lines of `faceLines`, with those of names. */
export class FaceLines extends NameLines {
  readonly #ranges: (readonly [tag: number, begin: number, end: number])[] = [];

  override readonly hear = (line: string): void => {
    this.hearName(line);
    const [, tag, ranges = ""] = /^\s*faces of patch (\d+): ([\d -]+)$/.exec(line) ?? [];
    for (const [, begin, end] of ranges.matchAll(/(\d+)-(\d+)/g)) {
      this.#ranges.push([Number(tag), Number(begin), Number(end)]);
    }
  };

  /** With the patches, where the lines are of all its faces and none is told twice; polygons had other numbers. */
  override given(mesh: FileMesh): FileMesh {
    const count = mesh.trianglePatch.length;
    const told = this.#ranges.reduce((sum, [, begin, end]) => sum + end + 1 - begin, 0);
    const isWhole = told === count && this.#ranges.every(([, begin, end]) => begin <= end && end < count);
    if (!isWhole || count === 0) return super.given(mesh);
    const patches = new GroupList("patch");
    const trianglePatch = new Uint32Array(count).fill(count);
    for (const [tag, begin, end] of this.#ranges) trianglePatch.fill(patches.tagged(tag), begin, end + 1);
    if (trianglePatch.includes(count)) return super.given(mesh);
    return super.given({ ...mesh, trianglePatch, patches: patches.groups() });
  }
}
