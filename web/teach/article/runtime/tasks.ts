/**
 * Tasks: conditions on the values of figures. The page notices when one holds, and says so. A reader who does not want to solve a
 * task can read its answer.
 */
import { effect } from "@preact/signals-core";
import { evaluate, parseCondition } from "../condition";
import { button } from "../kit/dom";
import type { PageFigures } from "./page-figure";

export interface TaskWatch {
  /** The tasks of the lesson, in their order. */
  readonly all: readonly HTMLElement[];
  /** Calls back when a task is done. */
  onDone(listener: (task: HTMLElement) => void): void;
}

export function watchTasks(figures: PageFigures): TaskWatch {
  const all = [...document.querySelectorAll<HTMLElement>(".task")];
  const listeners: ((task: HTMLElement) => void)[] = [];
  for (const task of all) {
    const until = parseCondition(task.dataset["until"] ?? "");
    const reveal = button({ class: "reveal" }, "Show the answer", () => showAnswer(task));
    task.querySelector(".ask")?.after(reveal);
    const stop = effect(() => {
      const value = evaluate(until, ({ figure, name }) => figures.get(figure)?.values.number(name) ?? NaN);
      if (value !== 1 || task.dataset["done"] === "true") return;
      task.dataset["done"] = "true";
      task.setAttribute("aria-label", `${task.getAttribute("aria-label") ?? ""}, done`);
      showAnswer(task);
      task.dispatchEvent(new Event("done"));
      queueMicrotask(() => {
        stop();
        for (const listener of listeners) listener(task);
      });
    });
  }
  return { all, onDone: (listener) => void listeners.push(listener) };
}

function showAnswer(task: HTMLElement): void {
  task.querySelector(".reveal")?.remove();
  task.querySelector(".because p")?.removeAttribute("hidden");
}
