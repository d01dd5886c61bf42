/** Checks whether a task is done: by the state of the player, or by an answer. */
import type { Trace } from "tetrafront/trace";
import type { FrontColoring } from "../player/front-values";
import { firstState } from "../player/phases";
import { nextStop } from "../player/stops";
import type { LessonTask, TaskOf } from "./lesson";

/** Share of an answer within which it may differ because decimal numbers are rounded. */
const rounding = 1e-12;

/** What the reader sees of the lesson's front. */
export interface ShownFront {
  readonly trace: Trace;
  readonly step: number;
  readonly coloring: FrontColoring;
  /** The step that was shown before, if the steps since then were played: many of them are shown at once. Default: one step before. */
  readonly after?: number;
}

/** Returns whether what is shown completes a task of the kinds `step` and `color`; false for the others. */
export function isShown(task: LessonTask, { coloring, ...steps }: ShownFront): boolean {
  if (task.kind === "color") return coloring === task.coloring;
  return task.kind === "step" && isReached(task, steps);
}

function isReached(
  { reach }: TaskOf<"step">,
  { trace, step, after = step - 1 }: Omit<ShownFront, "coloring">,
): boolean {
  if (reach === "end") return step === trace.stepCount;
  return step > firstState(trace) && nextStop(trace, after, 1, reach, step) !== null;
}

/** Returns whether an answer is right. Numbers may have a decimal comma and spaces between groups of digits. */
export function isRight(task: TaskOf<"number"> | TaskOf<"choice">, answer: string): boolean {
  if (task.kind === "choice") return answer === task.answer;
  const value = numberIn(answer);
  return value !== null && Math.abs(value - task.answer) <= task.tolerance + rounding * Math.abs(task.answer);
}

/** Groups of digits; a number below 1 has none, so that 0,103 has a decimal comma. */
const groupsOfDigits = /^[+-]?[1-9]\d{0,2}(,\d{3})+(?![\d,])/;

/** Returns the number that a text states; null if it states none. A comma before three digits separates groups if it can. */
export function numberIn(answer: string): number | null {
  const plain = answer.replace(/[\s\u00a0\u202f]/g, "");
  const number = groupsOfDigits.test(plain) ? plain.replaceAll(",", "") : plain.replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?%?$/i.test(number) ? parseFloat(number) : null;
}
