import { useEffect, type RefObject } from "react";

/** Lets the keyboard reach those of some elements in a box that are too wide for it and scroll, and only those. */
export function useScrollFocus(box: RefObject<HTMLElement | null>, selector: string, content: unknown): void {
  useEffect(() => {
    const element = box.current;
    if (!element) return undefined;
    const watch = new ResizeObserver(() => {
      for (const scrolling of element.querySelectorAll<HTMLElement>(selector)) {
        if (scrolling.scrollWidth > scrolling.clientWidth) scrolling.tabIndex = 0;
        else scrolling.removeAttribute("tabindex");
      }
    });
    watch.observe(element);
    return () => watch.disconnect();
  }, [box, selector, content]);
}
