/**
 * Names of patches and regions as lines of text: "patch 4 inlet". Formats that store only numbers keep these lines
 * in text that other programs ignore, such as comments.
 */
import type { MeshGroup, Mesh } from "../mesh/mesh.js";
import type { Note } from "./file-format.js";
import { hasDefaultName, listed, shortened, usedGroups } from "./groups.js";
import { GroupList } from "./mesh-builder.js";

/** Longest line in bytes; readers inspect no longer comments. */
const MAX_LINE_BYTES = 500;

/**
 * Returns one line per group that has elements and an informative name; without line ends. Groups without elements
 * are skipped: a reader would take their name for that of another group.
 */
export function nameLines(word: "patch" | "region", mesh: Mesh, note: Note): string[] {
  const [groups, owners] =
    word === "patch" ? [mesh.patches, mesh.trianglePatch] : [mesh.regions, mesh.tetrahedronRegion];
  const used = usedGroups(owners, groups);
  const cut: string[] = [];
  const lines = groups.flatMap((group, g) => {
    if (hasDefaultName(word, group) || !used.has(g)) return [];
    const whole = `${word} ${group.tag} ${group.name.replace(/\s+/g, " ").trim()}`;
    const line = shortened(whole, MAX_LINE_BYTES);
    if (line !== whole) cut.push(`${word} ${group.tag}`);
    return [line];
  });
  if (cut.length > 0)
    note(`names are truncated to fit into comment lines of ${MAX_LINE_BYTES} bytes: ${listed(cut)}`);
  return lines;
}

/** Returns the lines of patches and regions. */
export function allNameLines(mesh: Mesh, note: Note): string[] {
  return [...nameLines("patch", mesh, note), ...nameLines("region", mesh, note)];
}

/** Collects the names that such lines in a file define; other lines are ignored. */
export class NameLines {
  readonly patches = new Map<number, string>();
  readonly regions = new Map<number, string>();

  readonly readComment: (line: string) => void = (line) => this.readName(line);

  /** Adds the name of a patch (dimension 2) or a region (dimension 3), unless a line defines another. */
  addName(dimension: number, tag: number, name: string): void {
    const names = dimension === 2 ? this.patches : this.regions;
    if (!names.has(tag)) names.set(tag, name);
  }

  protected readName(line: string): void {
    const [, word, tag, name = ""] = /^\s*(patch|region) (\d+) (.*\S)\s*$/.exec(line) ?? [];
    if (word !== undefined) (word === "patch" ? this.patches : this.regions).set(Number(tag), name);
  }

  /**
   * Returns the mesh with the names. If the mesh and the lines have one patch each, the name applies whatever the
   * tag.
   */
  applyTo(mesh: Mesh): Mesh {
    const { patches, regions } = mesh;
    const [only, ...others] = this.patches;
    const isOne = only !== undefined && others.length === 0 && patches.length === 1;
    const named = (groups: readonly MeshGroup[], names: ReadonlyMap<number, string>) =>
      groups.map((group) => ({ ...group, name: names.get(group.tag) ?? group.name }));
    return {
      ...mesh,
      patches: isOne ? [{ ...patches[0], tag: only[0], name: only[1] }] : named(patches, this.patches),
      regions: named(regions, this.regions),
    };
  }
}

/** Separates the lines where a format has only one line for all. */
export const NAME_BREAK = "; ";

export const STL_TITLE = "binary STL";
/** Beginning of an STL header that lists the names of the patches in the order of their numbers. */
export const STL_NAMES = `${STL_TITLE}: `;

/** Largest number of face ranges per line. */
const RANGES_PER_LINE = 100;

/**
 * Returns lines such as "faces of patch 4: 0-11 20-20", for formats that store nothing per face; none for a single
 * patch.
 */
export function faceLines(owners: Uint32Array, groups: readonly MeshGroup[]): string[] {
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

/** Collects the lines of `faceLines`, besides those of names. */
export class FaceLines extends NameLines {
  readonly #ranges: (readonly [tag: number, begin: number, end: number])[] = [];

  override readonly readComment = (line: string): void => {
    this.readName(line);
    const [, tag, ranges = ""] = /^\s*faces of patch (\d+): ([\d -]+)$/.exec(line) ?? [];
    for (const [, begin, end] of ranges.matchAll(/(\d+)-(\d+)/g)) {
      this.#ranges.push([Number(tag), Number(begin), Number(end)]);
    }
  };

  /**
   * Also assigns the patches if the lines cover every face exactly once; otherwise they were written for other
   * polygons.
   */
  override applyTo(mesh: Mesh): Mesh {
    const count = mesh.trianglePatch.length;
    const covered = this.#ranges.reduce((sum, [, begin, end]) => sum + end + 1 - begin, 0);
    const isWhole = covered === count && this.#ranges.every(([, begin, end]) => begin <= end && end < count);
    if (!isWhole || count === 0) return super.applyTo(mesh);
    const patches = new GroupList("patch");
    const trianglePatch = new Uint32Array(count).fill(count);
    for (const [tag, begin, end] of this.#ranges) trianglePatch.fill(patches.tagged(tag), begin, end + 1);
    if (trianglePatch.includes(count)) return super.applyTo(mesh);
    return super.applyTo({ ...mesh, trianglePatch, patches: patches.groups() });
  }
}
