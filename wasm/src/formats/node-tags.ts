/** Maps the node tags of a file to node indices: most files count from 1, but any tag may occur. */
export class NodeTags {
  #count = 0;
  /** While there is no map, all tags so far are consecutive from this one on. */
  #first = 1;
  #map: Map<number, number> | undefined;

  /** Assigns this tag to the next node. If a tag occurs twice, the last node counts. */
  add(tag: number): void {
    if (this.#count === 0) this.#first = tag;
    if (this.#map === undefined && tag !== this.#first + this.#count) this.#map = this.#listed();
    this.#map?.set(tag, this.#count);
    this.#count++;
  }

  indexOf(tag: number): number | undefined {
    if (this.#map !== undefined) return this.#map.get(tag);
    const index = tag - this.#first;
    return Number.isInteger(index) && index >= 0 && index < this.#count ? index : undefined;
  }

  #listed(): Map<number, number> {
    const map = new Map<number, number>();
    for (let i = 0; i < this.#count; i++) map.set(this.#first + i, i);
    return map;
  }
}
