/** Elements that a file lists more than once, as Gmsh 2.2 does for each of their physical groups. */
import { Column } from "./column.js";
import { PointWelder } from "./weld.js";

/** Tells elements of one width apart by their nodes, in whatever order. O(1) expected for each, exact. */
export class RepeatedElements {
  /** Of sorted nodes three by three: equal ones are found as equal points are. */
  readonly #triples = new PointWelder();
  /** A tetrahedron is one of the triples and a fourth node. */
  readonly #pairs = new PointWelder();
  readonly #groups = new Column(Float64Array);

  /** The group of the first element with these three or four nodes; undefined where this is it. */
  firstGroup(nodes: readonly number[], group: number): number | undefined {
    const [a = 0, b = 0, c = 0, d] = [...nodes].sort((one, other) => one - other);
    const triple = this.#triples.add(a, b, c);
    const element = d === undefined ? triple : this.#pairs.add(triple, d, 0);
    if (element < this.#groups.length) return this.#groups.at(element);
    this.#groups.push(group);
    return undefined;
  }
}
