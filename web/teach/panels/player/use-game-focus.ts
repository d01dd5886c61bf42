import { useEffect, useRef, type RefObject } from "react";

/**
 * Moves the focus within a game, so that Enter is enough to go on: from a choice to the button of the next question, and from
 * that to the first choice. Elements with `data-next` and `data-choice` are these. `step`: of the question; null without one.
 */
export function useGameFocus(step: number | null, isAnswered: boolean): RefObject<HTMLDivElement | null> {
  const box = useRef<HTMLDivElement>(null);
  const wasOnNext = useRef(false);
  useEffect(() => {
    const game = box.current;
    const focus = (selector: string): void => game?.querySelector<HTMLElement>(selector)?.focus();
    if (isAnswered && game?.contains(document.activeElement)) {
      focus("[data-next]");
      wasOnNext.current = true;
    } else if (!isAnswered && wasOnNext.current) {
      wasOnNext.current = false;
      // The button with the focus is gone. Who has left the game keeps the focus.
      if (document.activeElement === document.body) focus("[data-choice]");
    }
  }, [step, isAnswered]);
  return box;
}
