import { Button, NativeSelect } from "@mantine/core";
import { useMemo, useState } from "react";
import { FRONT_ORDERS } from "tetrafront";
import { compareRun, showRun, type LessonRun } from "../../commands/lesson-actions";
import type { Lesson } from "../../lessons/lesson";
import { runMeasures } from "../../lessons/run-measures";
import { nameOfRules, rulesNamed, tolerances, usualRules, type RunRules } from "../../lessons/run-rules";
import { searchCost } from "../../lessons/search-cost";
import { lessonStrings } from "../../strings/lessons";
import tables from "../../../ui/table.module.css";
import { usePlayer } from "../player/use-player";
import { useApp } from "../../../panels/shared/app-context";
import styles from "./lessons.module.css";
import { StopRun } from "./stop-run";
import { useLessonRuns } from "./use-lessons";

const texts = lessonStrings.experiments;

/** Runs of the lesson's model with other rules, side by side. The address names them. */
export function Experiments({ lesson }: { readonly lesson: Lesson }) {
  const runs = useLessonRuns((state) => state.runs);
  return (
    <details className={styles["experiments"]} data-testid="experiments" data-unprinted>
      <summary>{texts.title}</summary>
      <p>{texts.intro}</p>
      <RuleChoices lesson={lesson} />
      {runs.length > 0 && (
        <>
          <RunTable runs={runs} />
          <p className={styles["how"]}>{texts.hint}</p>
        </>
      )}
    </details>
  );
}

/** Selects of the rules, and a button that runs with them. */
function RuleChoices({ lesson }: { readonly lesson: Lesson }) {
  const app = useApp();
  const [rules, setRules] = useState<RunRules>(usualRules);
  const [isRunning, setRunning] = useState(false);
  const { runs, isPreparing } = useLessonRuns((state) => state);
  const change = (part: Partial<RunRules>): void => setRules({ ...rules, ...part });
  const run = async (): Promise<void> => {
    setRunning(true);
    await compareRun(app, nameOfRules(rules));
    setRunning(false);
  };
  const onOff = [
    { value: "on", label: texts.on },
    { value: "off", label: texts.off },
  ];
  return (
    <>
      <div className={styles["rules"]}>
        <NativeSelect
          size="xs"
          label={texts.order}
          data-testid="experiment-order"
          value={rules.order ?? lesson.order}
          data={FRONT_ORDERS.map((value) => ({ value, label: lessonStrings.orders[value] }))}
          onChange={({ currentTarget: { value } }) => {
            const order = FRONT_ORDERS.find((known) => known === value && known !== lesson.order);
            change({ order: order ?? null });
          }}
        />
        <NativeSelect
          size="xs"
          label={texts.relaxation}
          value={rules.relaxation ? "on" : "off"}
          data={onOff}
          onChange={(event) => change({ relaxation: event.currentTarget.value === "on" })}
        />
        <NativeSelect
          size="xs"
          label={texts.filters}
          value={rules.filters ? "on" : "off"}
          data={onOff}
          onChange={(event) => change({ filters: event.currentTarget.value === "on" })}
        />
        <NativeSelect
          size="xs"
          label={texts.tolerance}
          data-testid="experiment-tolerance"
          value={String(rules.tolerance)}
          data={tolerances.map((value) => ({ value: String(value), label: texts.times(value) }))}
          onChange={(event) => change({ tolerance: Number(event.currentTarget.value) })}
        />
        <NativeSelect
          size="xs"
          label={texts.search}
          data-testid="experiment-search"
          value={rules.search}
          data={(["grid", "linear"] as const).map((value) => ({ value, label: texts.searches[value] }))}
          onChange={(event) => change({ search: event.currentTarget.value === "linear" ? "linear" : "grid" })}
        />
      </div>
      <Button
        size="compact-xs"
        variant="default"
        data-testid="experiment-run"
        disabled={isRunning || isPreparing || runs.length === 0}
        onClick={() => void run()}
      >
        {isRunning ? lessonStrings.running : texts.run}
      </Button>
      {isRunning && <StopRun testId="experiment-stop" />}
    </>
  );
}

/** Returns how many faces the search of a run has looked at. */
function facesCompared({ name, trace }: LessonRun): number {
  const { linear, near } = searchCost(trace, 1);
  const counts = rulesNamed(name)?.search === "linear" ? linear : near;
  return counts.at(-1) ?? 0;
}

function RunTable({ runs }: { readonly runs: readonly LessonRun[] }) {
  return (
    <table
      className={`${tables["table"]} ${tables["compact"]} ${styles["measures"]}`}
      aria-label={texts.title}
    >
      <thead>
        <tr>
          {texts.columns.map((column) => (
            <th key={column} scope="col">
              {column}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {runs.map((run) => (
          <Row key={run.name} run={run} />
        ))}
      </tbody>
    </table>
  );
}

function Row({ run }: { readonly run: LessonRun }) {
  const app = useApp();
  const isShown = usePlayer((state) => state.trace === run.trace);
  const { postponed, recoveries } = useMemo(() => runMeasures(run.trace), [run.trace]);
  const compared = useMemo(() => facesCompared(run), [run]);
  const { front, dihedral, radiusRatio } = run.report;
  const name = texts.name(run.name.split("+"), run.order);
  const values = [
    texts.count(compared),
    texts.count(front.facesAnalysed),
    lessonStrings.number(postponed),
    lessonStrings.number(recoveries),
    texts.degrees(dihedral.min),
    radiusRatio.mean.toFixed(3),
  ];
  return (
    <tr data-highlighted={isShown || undefined} data-testid={`experiment-${run.name || "usual"}`}>
      <th scope="row">
        <button
          type="button"
          className={styles["run"]}
          aria-pressed={isShown}
          aria-label={texts.show(name)}
          title={name}
          onClick={() => showRun(app, run)}
        >
          {name}
        </button>
      </th>
      {values.map((value, column) => (
        // The columns are fixed.
        <td key={column}>{value}</td>
      ))}
    </tr>
  );
}
