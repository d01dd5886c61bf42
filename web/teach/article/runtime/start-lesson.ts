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
import "../styles/twins.css";
import "../styles/dock.css";
import "../styles/modes.css";
import type { Value } from "../kit/values";
import { Dock } from "./dock";
import { tieChoices, tieDraggedNumbers, tieShownValues } from "./numbers";
import { keepOffline } from "./offline";
import { PageFigure } from "./page-figure";
import { showSingle, singleFigure } from "./single";
import { Slides } from "./slides";
import { watchTasks } from "./tasks";
import { startPrint } from "./print";
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
startPrint(figures);
const dock = new Dock(figures);
tieDraggedNumbers(figures, dock);
tieShownValues(figures);
tieChoices(figures);
tieWords(figures, dock);
const tasks = watchTasks(figures);
const single = singleFigure(figures);
if (single === null) {
  startWalks(figures);
  if (figures.size > 0) new Slides(figures);
  // Not for a figure in a course page, whose readers have not come to this site.
  void keepOffline(figures);
} else showSingle(figures, single, tasks);

declare global {
  interface Window {
    /** For tests: the values of all figures by their letters. */
    lesson?: { values(): Readonly<Record<string, Readonly<Record<string, Value>>>> };
  }
}
window.lesson = {
  values: () => Object.fromEntries([...figures].map(([id, { values }]) => [id, values.all()])),
};
