/** Finds elements that a file lists more than once, as Gmsh 2.2 does for each of their physical groups. */
import { Column } from "./column.js";
import { PointWelder } from "./weld.js";

/** Identifies elements of one kind by their set of nodes. O(1) expected per element; exact. */
export class DuplicateElements {
  /** Sorted node triples, identified in the same way as equal points. */
  readonly #triples = new PointWelder();
  /** A tetrahedron is a triple and its fourth node. */
  readonly #pairs = new PointWelder();
  readonly #groups = new Column(Float64Array);

  /** Returns the group of the first element with these three or four nodes; undefined if this is the first. */
  firstGroup(nodes: readonly number[], group: number): number | undefined {
    const [a = 0, b = 0, c = 0, d] = [...nodes].sort((one, other) => one - other);
    const triple = this.#triples.add(a, b, c);
    const element = d === undefined ? triple : this.#pairs.add(triple, d, 0);
    if (element < this.#groups.length) return this.#groups.at(element);
    this.#groups.push(group);
    return undefined;
  }
}
