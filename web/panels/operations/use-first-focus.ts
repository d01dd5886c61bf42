import { useEffect, type RefObject } from "react";

/**
 * Gives the focus to the first field of a panel. The palette or menu that has opened the panel returns the focus when it
 * closes, but not if the focus has moved since then: so this waits until it is closing, and keeps the focus until the
 * user acts.
 */
export function useFirstFocus(panel: RefObject<HTMLElement | null>): void {
  useEffect(() => {
    const focus = (): void => {
      const first = panel.current?.querySelector<HTMLInputElement | HTMLButtonElement>("input, button");
      // Keys reach only the chosen option of a choice, or the first option if none is chosen.
      const isChoice = first?.type === "radio";
      const chosen = isChoice && panel.current?.querySelector<HTMLInputElement>("input[type=radio]:checked");
      (chosen || first)?.focus();
    };
    const until = new AbortController();
    const options = { capture: true, signal: until.signal };
    const timer = setTimeout(focus);
    const keep = ({ target }: FocusEvent): void => {
      if (target instanceof Node && panel.current?.contains(target) !== true) focus();
    };
    window.addEventListener("focusin", keep, options);
    for (const act of ["keydown", "pointerdown"]) {
      window.addEventListener(act, () => until.abort(), options);
    }
    return () => {
      clearTimeout(timer);
      until.abort();
    };
  }, [panel]);
}
