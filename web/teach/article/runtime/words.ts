/** Words that lead a figure to a state, and words that light one of its parts. */
import { readDestination } from "../declaration";
import type { Dock } from "./dock";
import { tiedTo, type PageFigures } from "./page-figure";

/** Calls `act` for a click, and for Enter and the space bar. */
function onPress(node: HTMLElement, act: () => void): void {
  node.addEventListener("click", act);
  node.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    act();
  });
}

/** Leads the figure of a text such as `A step=end` to its state. */
export function goTo(figures: PageFigures, text: string): void {
  const destination = readDestination(text);
  if (destination) void figures.get(destination.figure)?.go(destination.entries);
}

export function tieWords(figures: PageFigures, dock: Dock): void {
  for (const node of document.querySelectorAll<HTMLElement>(".go"))
    onPress(node, () => {
      const text = node.dataset["go"] ?? "";
      const figure = figures.get(readDestination(text)?.figure ?? "");
      goTo(figures, text);
      if (figure) dock.touch(figure, node);
    });
  for (const node of document.querySelectorAll<HTMLElement>("[data-mark]")) {
    const { figure, name } = tiedTo(figures, node.dataset["mark"] ?? "");
    const light = (isLit: boolean, word: HTMLElement | null = node): void => {
      node.setAttribute("aria-pressed", String(isLit));
      void figure.mark(isLit ? name : null);
      if (isLit) dock.touch(figure, word);
    };
    // While the page is scrolled, words pass below a pointer at rest: if they moved the page, a click would miss its target.
    node.addEventListener("pointerenter", ({ pointerType }) => pointerType === "mouse" && light(true, null));
    node.addEventListener("pointerleave", ({ pointerType }) => pointerType === "mouse" && light(false));
    node.addEventListener("focus", () => node.matches(":focus-visible") && light(true));
    node.addEventListener("blur", () => light(false));
    // A finger has no place over a word: a tap lights the part, and another tap ends it.
    onPress(node, () => light(node.getAttribute("aria-pressed") !== "true"));
  }
}
