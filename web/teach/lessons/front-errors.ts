/** What of a lesson its front does not have. Only a recorded front can tell. */
import type { Trace } from "tetrafront/trace";
import { firstState } from "../player/phases";
import { stopKindsOf } from "../player/stops";
import type { Lesson } from "./lesson";

/** Returns a sentence for each field that asks for a step that the front of the lesson does not have, with its remedy. */
export function frontErrors({ id, model, step, tasks }: Lesson, trace: Trace): readonly string[] {
  const [first, last] = [firstState(trace), trace.stepCount];
  const kinds = stopKindsOf(trace);
  return [
    ...(step < first || step > last
      ? [
          `${id}.md: field "step" must be from ${first} to ${last}, the states of the front of "${model}", but is ${step}; correct it.`,
        ]
      : []),
    ...tasks.flatMap((task, i) =>
      task.kind !== "step" || task.reach === "end" || kinds.includes(task.reach)
        ? []
        : [
            `${id}.md: field "tasks.${i}.reach" is "${task.reach}", but the front of "${model}" has no such step; choose another kind: ${[...kinds, "end"].join(", ")}.`,
          ],
    ),
  ];
}
