import { useCallback, useEffect, useState, type RefObject } from "react";

/** Number of rows drawn beyond each edge of the window. */
const spare = 8;

export interface RowWindow {
  /** Rows `first` to `last - 1` are in sight or close to it. */
  readonly first: number;
  readonly last: number;
  /** Scrolls as little as possible so that a row is in sight. */
  readonly scrollTo: (row: number) => void;
}

/** Tracks which rows of equal height a scrolling element shows. */
export function useRowWindow(
  scroller: RefObject<HTMLElement | null>,
  rowCount: number,
  rowHeight: number,
): RowWindow {
  const [range, setRange] = useState<readonly [number, number]>([0, 60]);
  useEffect(() => {
    const element = scroller.current;
    if (!element) return undefined;
    const update = (): void =>
      setRange([
        Math.max(0, Math.floor(element.scrollTop / rowHeight) - spare),
        Math.ceil((element.scrollTop + element.clientHeight) / rowHeight) + spare,
      ]);
    update();
    element.addEventListener("scroll", update, { passive: true });
    const observer = new ResizeObserver(update);
    observer.observe(element);
    return () => {
      element.removeEventListener("scroll", update);
      observer.disconnect();
    };
  }, [scroller, rowHeight]);
  const scrollTo = useCallback(
    (row: number): void => {
      const element = scroller.current;
      if (!element) return;
      const top = row * rowHeight;
      if (top < element.scrollTop) element.scrollTop = top;
      else if (top + rowHeight > element.scrollTop + element.clientHeight) {
        element.scrollTop = top + rowHeight - element.clientHeight;
      }
    },
    [scroller, rowHeight],
  );
  return { first: range[0], last: Math.min(rowCount, range[1]), scrollTo };
}
