import { Button } from "@mantine/core";
import { useMemo, useState } from "react";
import { compareRun, showRun } from "../../commands/lesson-actions";
import type { TaskOf } from "../../lessons/lesson";
import { runMeasures } from "../../lessons/run-measures";
import { lessonStrings as texts } from "../../strings/lessons";
import tables from "../../../ui/table.module.css";
import { usePlayer } from "../player/use-player";
import { useApp } from "../../../panels/shared/app-context";
import styles from "./lessons.module.css";
import { StopRun } from "./stop-run";
import type { TaskProps } from "./task-props";
import { useLessonRuns } from "./use-lessons";

/** Records the front in another order, and shows all orders side by side in a table. */
export function CompareTask({ task, number, onDone }: TaskProps<TaskOf<"compare">>) {
  const app = useApp();
  const [isRunning, setRunning] = useState(false);
  const { runs, isPreparing } = useLessonRuns((state) => state);
  const run = async (): Promise<void> => {
    setRunning(true);
    if (await compareRun(app, task.order)) onDone();
    setRunning(false);
  };
  return (
    <div className={styles["compare"]}>
      <Button
        size="compact-xs"
        variant="default"
        disabled={isRunning || isPreparing || runs.length === 0}
        data-testid={`lesson-compare-${number}`}
        onClick={() => void run()}
      >
        {isRunning ? texts.running : texts.compare(task.order)}
      </Button>
      {isRunning && <StopRun testId={`lesson-stop-${number}`} />}
      {runs.some(({ name }) => name === task.order) && <RunTable number={number} />}
    </div>
  );
}

/** The fronts in all orders in which the lesson was run, side by side: a column each, the lesson's own first. */
function RunTable({ number }: { readonly number: number }) {
  const app = useApp();
  const all = useLessonRuns((state) => state.runs);
  const columns = useMemo(
    () =>
      all
        .filter(({ name, order }) => name === "" || name === order)
        .map((run) => ({ run, measures: runMeasures(run.trace) })),
    [all],
  );
  const shown = usePlayer((state) => state.trace);
  return (
    <>
      <table
        className={`${tables["table"]} ${tables["compact"]} ${styles["orders"]}`}
        aria-label={texts.runs}
      >
        <thead>
          <tr>
            <th scope="col">{texts.runMeasure}</th>
            {columns.map(({ run }) => (
              <th key={run.name} scope="col" data-highlighted={run.trace === shown || undefined}>
                <button
                  type="button"
                  className={styles["run"]}
                  aria-pressed={run.trace === shown}
                  aria-label={texts.showRun(run.order)}
                  data-testid={`lesson-run-${number}-${run.order}`}
                  onClick={() => showRun(app, run)}
                >
                  {texts.orders[run.order]}
                </button>
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {measureNames.map((name) => (
            <tr key={name}>
              <th scope="row">{texts.run[name]}</th>
              {columns.map(({ run, measures }) => (
                <td key={run.name} data-highlighted={run.trace === shown || undefined}>
                  {texts.number(measures[name])}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
      <p className={styles["how"]}>{texts.runHint}</p>
    </>
  );
}

const measureNames = ["crossings", "smallCrossings", "postponed", "flat"] as const;
