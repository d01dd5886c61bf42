/** Number of entries per map: JavaScript's maps hold at most 2^24. */
const MAP_ENTRIES = 2 ** 23;

/** Maps the node tags of a file to node indices: most files count from 1, but any tag may occur. */
export class NodeTags {
  #count = 0;
  /** While there is no map, all tags so far are consecutive from this one on. */
  #first = 1;
  /** The last map counts first. */
  readonly #maps: Map<number, number>[] = [];
  readonly #entries: number;

  constructor(entriesPerMap = MAP_ENTRIES) {
    this.#entries = entriesPerMap;
  }

  /** Assigns this tag to the next node. If a tag occurs twice, the last node counts. */
  add(tag: number): void {
    if (this.#count === 0) this.#first = tag;
    if (this.#maps.length === 0 && tag !== this.#first + this.#count)
      for (let i = 0; i < this.#count; i++) this.#set(this.#first + i, i);
    if (this.#maps.length > 0) this.#set(tag, this.#count);
    this.#count++;
  }

  indexOf(tag: number): number | undefined {
    if (this.#maps.length === 0) {
      const index = tag - this.#first;
      return Number.isInteger(index) && index >= 0 && index < this.#count ? index : undefined;
    }
    for (let m = this.#maps.length - 1; m >= 0; m--) {
      const index = this.#maps[m]?.get(tag);
      if (index !== undefined) return index;
    }
    return undefined;
  }

  #set(tag: number, index: number): void {
    let map = this.#maps.at(-1);
    if (map === undefined || map.size >= this.#entries) {
      map = new Map();
      this.#maps.push(map);
    }
    map.set(tag, index);
  }
}
