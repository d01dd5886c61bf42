/** Positions of nodes by the numbers that a file gives them: most files count from 1, any number may come. */
export class NodeTags {
  #count = 0;
  /** All nodes so far are numbered from this one on, without a gap, unless there is a map. */
  #first = 1;
  #map: Map<number, number> | undefined;

  /** The next node has this number; where two have it, the last counts. */
  add(tag: number): void {
    if (this.#count === 0) this.#first = tag;
    if (this.#map === undefined && tag !== this.#first + this.#count) this.#map = this.#listed();
    this.#map?.set(tag, this.#count);
    this.#count++;
  }

  positionOf(tag: number): number | undefined {
    if (this.#map !== undefined) return this.#map.get(tag);
    const position = tag - this.#first;
    return Number.isInteger(position) && position >= 0 && position < this.#count ? position : undefined;
  }

  #listed(): Map<number, number> {
    const map = new Map<number, number>();
    for (let i = 0; i < this.#count; i++) map.set(this.#first + i, i);
    return map;
  }
}
