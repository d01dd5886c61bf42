/**
 * Tree of bounding boxes over the items of a closed chain in the plane. Items that are neighbours in the chain are
 * close in the plane, so repeated halving of the chain gives a good tree without sorting.
 */

/** Number of items below a leaf. */
const LEAF = 4;
/** Numbers per box: lowest x y, highest x y. In an empty box the lowest exceed the highest. */
const BOX = 4;
export const EMPTY_BOX = [Infinity, Infinity, -Infinity, -Infinity] as const;

/** Number of comparisons left; below 0 the operation gives up. */
export interface Work {
  left: number;
}

export class ChainTree {
  /** One box per item. */
  readonly #items: Float64Array;
  /** Boxes of the nodes. Node n has the children 2 n and 2 n + 1; the second half of the nodes are leaves. */
  readonly #nodes: Float64Array;
  readonly #leaves: number;

  /** Builds the tree from four numbers per item. Takes ownership of `boxes`. O(n). */
  constructor(boxes: Float64Array) {
    this.#items = boxes;
    let leaves = 1;
    while (LEAF * BOX * leaves < boxes.length) leaves *= 2;
    this.#leaves = leaves;
    this.#nodes = new Float64Array(2 * BOX * leaves);
    for (let node = 2 * leaves - 1; node > 0; node--) this.#fit(node);
  }

  /** Removes an item. O(log n). */
  drop(item: number): void {
    this.#items.set(EMPTY_BOX, BOX * item);
    // Update the ancestors until one does not change.
    for (let node = this.#leaves + Math.floor(item / LEAF); node > 0 && this.#fit(node); node >>= 1);
  }

  /** Returns whether an item whose box intersects `box` passes the test, or the work limit is reached. */
  someMeeting(box: Float64Array, work: Work, test: (item: number) => boolean): boolean {
    const visit = (node: number): boolean => {
      if (--work.left < 0) return true;
      if (!meet(this.#nodes, node, box, 0)) return false;
      if (node < this.#leaves) return visit(2 * node) || visit(2 * node + 1);
      work.left -= LEAF;
      const [begin, end] = this.#itemsOf(node);
      for (let item = begin; item < end; item++) {
        if (meet(this.#items, item, box, 0) && test(item)) return true;
      }
      return false;
    };
    return visit(1);
  }

  /** Returns whether two different items whose boxes intersect pass the test, or the work limit is reached. */
  somePair(work: Work, test: (one: number, other: number) => boolean): boolean {
    const visit = (one: number, other: number): boolean => {
      if (--work.left < 0) return true;
      if (!meet(this.#nodes, one, this.#nodes, other)) return false;
      if (one >= this.#leaves) return this.#someOfLeaves(one, other, work, test);
      const [low, high] = [2 * one, 2 * one + 1];
      const [left, right] = [2 * other, 2 * other + 1];
      return (
        visit(low, left) ||
        visit(high, right) ||
        visit(low, right) ||
        // For a node paired with itself, visit each pair of its halves once.
        (one !== other && visit(high, left))
      );
    };
    return visit(1, 1);
  }

  #someOfLeaves(
    one: number,
    other: number,
    work: Work,
    test: (one: number, other: number) => boolean,
  ): boolean {
    const [begin, end] = this.#itemsOf(one);
    const [otherBegin, otherEnd] = this.#itemsOf(other);
    work.left -= LEAF * LEAF;
    for (let i = begin; i < end; i++) {
      for (let j = one === other ? i + 1 : otherBegin; j < otherEnd; j++) {
        if (meet(this.#items, i, this.#items, j) && test(i, j)) return true;
      }
    }
    return false;
  }

  #itemsOf(leaf: number): readonly [begin: number, end: number] {
    const begin = LEAF * (leaf - this.#leaves);
    return [begin, Math.min(begin + LEAF, this.#items.length / BOX)];
  }

  /** Recomputes the box of a node; returns whether it changed. */
  #fit(node: number): boolean {
    if (node < this.#leaves) return this.#fitAround(node, this.#nodes, 2 * node, 2 * node + 2);
    const [begin, end] = this.#itemsOf(node);
    return this.#fitAround(node, this.#items, begin, end);
  }

  #fitAround(node: number, boxes: Float64Array, begin: number, end: number): boolean {
    let isChanged = false;
    for (let side = 0; side < BOX; side++) {
      let extreme = side < 2 ? Infinity : -Infinity;
      for (let at = BOX * begin + side; at < BOX * end; at += BOX) {
        const value = boxes[at] ?? extreme;
        if (side < 2 ? value < extreme : value > extreme) extreme = value;
      }
      isChanged ||= this.#nodes[BOX * node + side] !== extreme;
      this.#nodes[BOX * node + side] = extreme;
    }
    return isChanged;
  }
}

function meet(boxes: Float64Array, one: number, others: Float64Array, other: number): boolean {
  const [a, b] = [BOX * one, BOX * other];
  return (
    (boxes[a] ?? 0) <= (others[b + 2] ?? 0) &&
    (others[b] ?? 0) <= (boxes[a + 2] ?? 0) &&
    (boxes[a + 1] ?? 0) <= (others[b + 3] ?? 0) &&
    (others[b + 1] ?? 0) <= (boxes[a + 3] ?? 0)
  );
}
