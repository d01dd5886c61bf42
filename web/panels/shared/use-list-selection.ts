import { useRef, type MouseEvent } from "react";
import { listSelection } from "../../document/list-selection";

type Keys = Pick<MouseEvent, "shiftKey" | "ctrlKey" | "metaKey">;

/**
 * Returns what a click on an item of a list does: it selects the item; with Shift, all items from the one that was clicked before;
 * with Ctrl, it adds or removes the item; with both, it adds the range.
 */
export function useListSelection<Item>(
  items: readonly Item[],
  selected: readonly Item[],
  onSelect: (next: readonly Item[]) => void,
): (item: Item, keys: Keys) => void {
  const anchor = useRef<Item | null>(null);
  return (item, { shiftKey, ctrlKey, metaKey }) => {
    const keys = { range: shiftKey, toggle: ctrlKey || metaKey };
    onSelect(listSelection(items, selected, { item, anchor: anchor.current, ...keys }));
    if (!shiftKey || anchor.current === null) anchor.current = item;
  };
}
