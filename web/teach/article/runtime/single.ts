/**
 * A figure alone, for a course page: `lessons/N/?figure=A` in a frame shows the figure and its tasks. The page around it hears of
 * finished tasks by messages (docs/LESSONS.md).
 */
import { parseCondition, valuesIn } from "../condition";
import { element } from "../kit/dom";
import type { PageFigures } from "./page-figure";
import type { TaskWatch } from "./tasks";

export interface FrameMessage {
  readonly source: "tetrafront";
  readonly type: "ready" | "task" | "height";
  readonly lesson: number;
  readonly figure: string;
  /** Number of the task within the lesson; only with `task`. */
  readonly task?: number;
  /** The question of the task as text; only with `task`. */
  readonly ask?: string;
  /** How many tasks of the figure are done, and how many there are. */
  readonly done: number;
  readonly total: number;
  /** Height of the content in pixels. */
  readonly height: number;
}

/** Returns the letter of the figure that the address asks for; null if it asks for the whole lesson. */
export function singleFigure(figures: PageFigures): string | null {
  const letter = new URLSearchParams(location.search).get("figure");
  return letter !== null && figures.has(letter) ? letter : null;
}

export function showSingle(figures: PageFigures, letter: string, tasks: TaskWatch): void {
  const figure = figures.get(letter);
  const main = document.querySelector("main");
  if (!figure || !main) return;
  document.documentElement.dataset["single"] = letter;
  const own = tasks.all.filter((task) => {
    const names = valuesIn(parseCondition(task.dataset["until"] ?? ""));
    return names.length > 0 && names.every((value) => value.figure === letter);
  });
  const lesson = Number(/lessons\/(\d+)\//.exec(location.pathname)?.[1] ?? NaN);
  const origin = element("p", { class: "origin" });
  const address = new URL(location.href);
  address.search = "";
  address.hash = figure.element.id;
  origin.append(
    "From ",
    element(
      "a",
      { href: address.href, target: "_blank", rel: "noopener" },
      document.title.replace(/ – .*/, ""),
    ),
  );
  // The numbers that the text would offer stand below the figure.
  const inputs = Object.entries(figure.plan.ranges).flatMap(([name, { label }]) => {
    const number = document.querySelector(`[data-drag="${letter}.${name}"]`);
    return number ? [element("span", {}, `${label} `, number)] : [];
  });
  main.replaceChildren(figure.element, element("p", { class: "inputs" }, ...inputs), ...own, origin);
  const say = (type: FrameMessage["type"], task?: HTMLElement): void => {
    const message: FrameMessage = {
      source: "tetrafront",
      type,
      lesson,
      figure: letter,
      ...(task && { task: tasks.all.indexOf(task) + 1, ask: task.querySelector(".ask")?.textContent ?? "" }),
      done: own.filter(({ dataset }) => dataset["done"] === "true").length,
      total: own.length,
      height: Math.ceil(main.getBoundingClientRect().height),
    };
    // The page around it may be any course page, and the message holds nothing about the reader.
    if (window.parent !== window) window.parent.postMessage(message, "*");
  };
  tasks.onDone((task) => own.includes(task) && say("task", task));
  void figure.load().then(() => say("ready"));
  new ResizeObserver(() => say("height")).observe(main);
}
