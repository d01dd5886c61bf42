import { useLayoutEffect, type RefObject } from "react";

/** Lets the keyboard reach those of some elements in a box that are too wide for it and scroll, and only those. */
export function useScrollFocus(box: RefObject<HTMLElement | null>, selector: string, content: unknown): void {
  useLayoutEffect(() => {
    const element = box.current;
    if (!element) return undefined;
    const check = (): void => {
      for (const scrolling of element.querySelectorAll<HTMLElement>(selector)) {
        if (scrolling.scrollWidth > scrolling.clientWidth) scrolling.tabIndex = 0;
        else scrolling.removeAttribute("tabindex");
      }
    };
    // At once: new content must not be out of reach until the observer is called.
    check();
    const watch = new ResizeObserver(check);
    watch.observe(element);
    // A font that arrives later changes the width of the text, but not that of the box.
    document.fonts.addEventListener("loadingdone", check);
    return () => {
      watch.disconnect();
      document.fonts.removeEventListener("loadingdone", check);
    };
  }, [box, selector, content]);
}
