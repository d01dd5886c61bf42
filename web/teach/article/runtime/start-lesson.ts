/** The first script of the pages of lessons: ties the text to its figures. */
import "katex/dist/katex.min.css";
import "../styles/fonts.css";
import "../styles/page.css";
import "../styles/text.css";
import "../styles/figures.css";
import "../styles/mesher.css";
import "../styles/pocket.css";
import "../styles/slivers.css";
import "../styles/race.css";
import "../styles/sides.css";
import type { Value } from "../kit/values";
import { tieDraggedNumbers, tieShownValues } from "./numbers";
import { PageFigure } from "./page-figure";
import { watchTasks } from "./tasks";
import { startTheme } from "./theme";
import { startWalks } from "./walks";
import { tieWords } from "./words";

const figures = new Map(
  [...document.querySelectorAll<HTMLElement>("[data-figure]")].map((element) => {
    const figure = new PageFigure(element);
    return [figure.plan.id, figure] as const;
  }),
);

startTheme();
tieDraggedNumbers(figures);
tieShownValues(figures);
tieWords(figures);
watchTasks(figures);
startWalks(figures);

declare global {
  interface Window {
    /** For tests: the values of all figures by their letters. */
    lesson?: { values(): Readonly<Record<string, Readonly<Record<string, Value>>>> };
  }
}
window.lesson = {
  values: () => Object.fromEntries([...figures].map(([id, { values }]) => [id, values.all()])),
};
