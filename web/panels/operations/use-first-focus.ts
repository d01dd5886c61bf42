import { useEffect, type RefObject } from "react";

/**
 * Gives the focus to the first field of a panel, and keeps it there until the user acts: the palette or menu that has
 * opened the panel returns the focus to where it was, when it has closed.
 */
export function useFirstFocus(panel: RefObject<HTMLElement | null>): void {
  useEffect(() => {
    const focus = (): void => panel.current?.querySelector<HTMLElement>("input, button")?.focus();
    const until = new AbortController();
    const options = { capture: true, signal: until.signal };
    focus();
    const keep = ({ target }: FocusEvent): void => {
      if (target instanceof Node && panel.current?.contains(target) !== true) focus();
    };
    window.addEventListener("focusin", keep, options);
    for (const act of ["keydown", "pointerdown"]) {
      window.addEventListener(act, () => until.abort(), options);
    }
    return () => until.abort();
  }, [panel]);
}
