/** A click on an item of a list. */
export interface ListClick<Item> {
  readonly item: Item;
  /** The item that was clicked last without `range`; null if there is none. */
  readonly anchor: Item | null;
  /** Shift: all items from the anchor to this one. */
  readonly range: boolean;
  /** Ctrl: the item is added or removed; with `range`, the range is added. */
  readonly toggle: boolean;
}

/** Returns the selection after a click, in the order in which it was made. Items are compared by identity. O(items). */
export function listSelection<Item>(
  items: readonly Item[],
  selected: readonly Item[],
  { item, anchor, range, toggle }: ListClick<Item>,
): readonly Item[] {
  if (range) {
    const between = rangeOf(items, anchor, item);
    return toggle ? [...selected, ...between.filter((other) => !selected.includes(other))] : between;
  }
  if (!toggle) return [item];
  return selected.includes(item) ? selected.filter((other) => other !== item) : [...selected, item];
}

/** Returns the items from one to another, both included, in this direction; without the first one, the last one alone. */
function rangeOf<Item>(items: readonly Item[], anchor: Item | null, item: Item): readonly Item[] {
  const from = anchor === null ? -1 : items.indexOf(anchor);
  const to = items.indexOf(item);
  if (from < 0 || to < 0) return [item];
  return from <= to ? items.slice(from, to + 1) : items.slice(to, from + 1).toReversed();
}
