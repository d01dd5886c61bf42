/**
 * Counts memberships of elements in further physical groups of a Gmsh file, which are dropped: an element belongs
 * to its first group only.
 */
import { plural } from "../base/plural.js";
import { listed } from "./groups.js";

interface ExtraGroup {
  readonly dimension: number;
  readonly tag: number;
  elements: number;
}

/** By dimension; only triangles and tetrahedra are read. */
const NOUNS: Readonly<Record<number, string>> = { 2: "triangle", 3: "tetrahedron" };

export class ExtraGroups {
  readonly #groups = new Map<string, ExtraGroup>();

  /** Counts elements of this dimension that also belong to the group of this tag. */
  add(dimension: number, tag: number, elements: number): void {
    const key = `${dimension} ${tag}`;
    const known = this.#groups.get(key);
    if (known === undefined) this.#groups.set(key, { dimension, tag, elements });
    else known.elements += elements;
  }

  /** Returns one sentence per dimension that names the groups. */
  notes(names: Readonly<Record<number, ReadonlyMap<number, string>>>): string[] {
    return [2, 3].flatMap((dimension) => {
      const extra = [...this.#groups.values()].filter((group) => group.dimension === dimension);
      if (extra.length === 0) return [];
      const dropped = extra.map(({ tag, elements }) => {
        const name = names[dimension]?.get(tag);
        return `${plural(elements, NOUNS[dimension] ?? "element")} of ${name === undefined ? `group ${tag}` : `"${name}"`}`;
      });
      return [`elements in several physical groups stay only in their first; dropped: ${listed(dropped)}`];
    });
  }
}
