/** Physical groups that elements of Gmsh's files have beside the one that counts. */
import { plural } from "../base/plural.js";
import { listed } from "./groups.js";

interface LostGroup {
  readonly dimension: number;
  readonly tag: number;
  elements: number;
}

/** The only numbers of dimensions here: of triangles and tetrahedra. */
const NOUNS: Readonly<Record<number, string>> = { 2: "triangle", 3: "tetrahedron" };

export class LostGroups {
  readonly #groups = new Map<string, LostGroup>();

  /** So many elements of this dimension are in that group, too. */
  add(dimension: number, tag: number, elements: number): void {
    const key = `${dimension} ${tag}`;
    const known = this.#groups.get(key);
    if (known === undefined) this.#groups.set(key, { dimension, tag, elements });
    else known.elements += elements;
  }

  /** One sentence for each dimension, naming the groups. */
  notes(names: Readonly<Record<number, ReadonlyMap<number, string>>>): string[] {
    return [2, 3].flatMap((dimension) => {
      const lost = [...this.#groups.values()].filter((group) => group.dimension === dimension);
      if (lost.length === 0) return [];
      const told = lost.map(({ tag, elements }) => {
        const name = names[dimension]?.get(tag);
        return `${plural(elements, NOUNS[dimension] ?? "element")} of ${name === undefined ? `group ${tag}` : `"${name}"`}`;
      });
      return [
        `elements in several physical groups are in their first alone, and lost to others: ${listed(told)}`,
      ];
    });
  }
}
