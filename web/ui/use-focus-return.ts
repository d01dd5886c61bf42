import { useEffect, useLayoutEffect, useRef } from "react";

/** Returns whether the element that had the focus is gone. */
export const isFocusLost = (): boolean =>
  document.activeElement === document.body || document.activeElement === null;

/** Returns the focus to an element, or to the view if there is none any more. */
function giveFocus(before: Element | null): void {
  const isThere = before instanceof HTMLElement && before !== document.body && before.isConnected;
  (isThere ? before : document.querySelector<HTMLElement>("main canvas"))?.focus({ preventScroll: true });
}

/**
 * Returns the focus of an overlay when it closes, also if it was mounted open: to the element that had it before, or to the
 * view if that one is gone. The focus stays where it is if it was moved meanwhile.
 */
export function useFocusReturn(opened: boolean): void {
  const before = useRef<Element | null>(null);
  // Before the overlay takes the focus.
  useLayoutEffect(() => {
    if (opened) before.current = document.activeElement;
  }, [opened]);
  useEffect(() => {
    if (!opened) return undefined;
    return () => {
      const last = document.activeElement;
      if (!isFocusLost() && !last?.closest('[role="dialog"]')) return;
      // What closed the overlay may move the focus next.
      setTimeout(() => {
        if (isFocusLost() || document.activeElement === last) giveFocus(before.current);
      });
    };
  }, [opened]);
}
