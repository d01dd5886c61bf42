import { Button } from "@mantine/core";
import { useMemo, useState } from "react";
import type { FrontOrder, Trace } from "tetrafront";
import { compareRun, showRun } from "../../commands/lesson-actions";
import type { TaskOf } from "../../lessons/lesson";
import { runMeasures } from "../../lessons/run-measures";
import { lessonStrings as texts } from "../../strings/lessons";
import tables from "../../ui/table.module.css";
import { usePlayer } from "../player/use-player";
import { useApp } from "../shared/app-context";
import styles from "./lessons.module.css";
import type { TaskProps } from "./task-props";
import { useLessonRuns } from "./use-lessons";

/** Records the front in another order, and shows both runs side by side in a table. */
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
      {runs.some(({ name }) => name === task.order) && <RunTable other={task.order} number={number} />}
    </div>
  );
}

interface RunTableProps {
  readonly other: FrontOrder;
  readonly number: number;
}

/** The front of the lesson and one in another order. */
function RunTable({ other, number }: RunTableProps) {
  const app = useApp();
  const all = useLessonRuns((state) => state.runs);
  const runs = all.filter(({ name }) => name === "" || name === other);
  const shown = usePlayer((state) => state.trace);
  return (
    <>
      <table className={`${tables["table"]} ${tables["compact"]}`} aria-label={texts.runs}>
        <thead>
          <tr>
            <th scope="col">{texts.run.order}</th>
            <th scope="col">{texts.run.crossings}</th>
            <th scope="col">{texts.run.smallCrossings}</th>
            <th scope="col">{texts.run.postponed}</th>
            <th scope="col">{texts.run.flat}</th>
          </tr>
        </thead>
        <tbody>
          {runs.map((run) => (
            <tr key={run.name} data-highlighted={run.trace === shown || undefined}>
              <th scope="row">
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
              <Measures trace={run.trace} />
            </tr>
          ))}
        </tbody>
      </table>
      <p className={styles["how"]}>{texts.runHint}</p>
    </>
  );
}

function Measures({ trace }: { readonly trace: Trace }) {
  const { crossings, smallCrossings, postponed, flat } = useMemo(() => runMeasures(trace), [trace]);
  return [crossings, smallCrossings, postponed, flat].map((value, column) => (
    // The columns are fixed.
    <td key={column}>{texts.number(value)}</td>
  ));
}
