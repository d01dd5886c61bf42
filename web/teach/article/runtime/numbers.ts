/** Numbers in sentences and formulas: those that the reader drags, and those that follow a figure. */
import { effect, untracked } from "@preact/signals-core";
import { evaluate, parseCondition, valuesIn, type ValueName } from "../condition";
import { digits } from "../kit/dom";
import type { Dock } from "./dock";
import { tiedTo, type PageFigures } from "./page-figure";

/** Pixels of a pointer over which a number runs through its whole range. */
const dragLength = 240;
const placesOf = (text: string): number => (text.split(".")[1] ?? "").replace(/\D.*$/, "").length;

/** Makes every scrubbable number follow the pointer and the keys. */
export function tieDraggedNumbers(figures: PageFigures, dock: Dock): void {
  for (const node of document.querySelectorAll<HTMLElement>("[data-drag]")) {
    const { figure, name } = tiedTo(figures, node.dataset["drag"] ?? "");
    const range = figure.values.range(name);
    if (!range) continue;
    const places = placesOf(String(range.step));
    const unit = node.dataset["unit"] ?? "";
    effect(() => {
      const value = figure.values.number(name);
      node.textContent = `${digits(value, places)}${unit}`;
      node.setAttribute("aria-valuenow", String(value));
      node.setAttribute("aria-valuetext", `${value.toFixed(places)}${unit}`);
    });
    const ask = (value: number): void => {
      void figure.load();
      figure.values.ask(name, value);
      dock.touch(figure, node);
    };
    node.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      node.focus({ preventScroll: true });
      node.setPointerCapture(event.pointerId);
      node.classList.add("held");
      const [x, start] = [event.clientX, figure.values.number(name)];
      const move = ({ clientX }: PointerEvent): void =>
        ask(start + ((clientX - x) / dragLength) * (range.max - range.min));
      node.addEventListener("pointermove", move);
      const end = (): void => {
        node.classList.remove("held");
        node.removeEventListener("pointermove", move);
      };
      for (const type of ["pointerup", "pointercancel"]) node.addEventListener(type, end, { once: true });
    });
    node.addEventListener("keydown", (event) => {
      const value = keyedValue(event.key, figure.values.number(name), range);
      if (value === null) return;
      event.preventDefault();
      ask(value);
    });
  }
}

interface Limits {
  readonly min: number;
  readonly max: number;
  readonly step: number;
}

/** Returns the value that a key of a slider asks for; null for other keys. */
export function keyedValue(key: string, value: number, { min, max, step }: Limits): number | null {
  const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10 }[key];
  if (steps !== undefined) return value + steps * step;
  return key === "Home" ? min : key === "End" ? max : null;
}

/**
 * Makes every shown number and every value in a formula follow its figure, with the digits that the author wrote. In the answer of
 * a task, the author's numbers are those of a solution. Once the reader has found one, its numbers take their place, and stay.
 */
export function tieShownValues(figures: PageFigures): void {
  for (const node of document.querySelectorAll<HTMLElement>("[data-show]")) {
    const { figure, name } = tiedTo(figures, node.dataset["show"] ?? "");
    const places = placesOf(node.textContent);
    follow(node, () => {
      const value = figure.values.get(name);
      if (value === undefined) return;
      const text = typeof value === "number" ? digits(value, places) : value;
      if (node.textContent !== text) node.textContent = text;
    });
  }
  for (const formula of document.querySelectorAll<HTMLElement>(".formula[aria-label*='{']")) {
    const template = formula.getAttribute("aria-label") ?? "";
    const shown = new Map(
      [...formula.querySelectorAll<HTMLElement>("[data-show]")].map((node) => [
        node.dataset["show"] ?? "",
        { text: node.textContent, places: placesOf(node.textContent) },
      ]),
    );
    const label = (textOf: (target: string) => string): void =>
      formula.setAttribute(
        "aria-label",
        template.replaceAll(/\{([A-Z]\.\w+)\}/g, (_whole, target: string) => textOf(target)),
      );
    label((target) => shown.get(target)?.text ?? "");
    follow(formula, () =>
      label((target) => {
        const { figure, name } = tiedTo(figures, target);
        const value = figure.values.get(name);
        return typeof value === "number" ? digits(value, shown.get(target)?.places ?? 2) : (value ?? "");
      }),
    );
  }
}

/** Shows of each choice in the text the first branch whose condition holds. */
export function tieChoices(figures: PageFigures): void {
  for (const choice of document.querySelectorAll<HTMLElement>("[data-choice]")) {
    const branches = [...choice.querySelectorAll<HTMLElement>("[data-if]")].map((node) => {
      const condition = node.dataset["if"] ?? "";
      return { node, condition: condition === "" ? null : parseCondition(condition) };
    });
    const names = branches.flatMap(({ condition }) => (condition ? valuesIn(condition) : []));
    follow(choice, () => {
      const valueOf = ({ figure, name }: ValueName): number =>
        tiedTo(figures, `${figure}.${name}`).figure.values.number(name);
      // Before the figure is loaded, the author's first text stands.
      if (names.map(valueOf).some(Number.isNaN)) return;
      const shown = branches.find(({ condition }) => !condition || evaluate(condition, valueOf) === 1);
      for (const { node } of branches) node.hidden = node !== shown?.node;
    });
  }
}

/** Acts now and whenever a value changes that it reads; for a node in the answer of a task once, when the task is done. */
function follow(node: HTMLElement, act: () => void): void {
  const task = node.closest(".because")?.closest(".task");
  if (task) task.addEventListener("done", () => untracked(act), { once: true });
  else effect(act);
}
