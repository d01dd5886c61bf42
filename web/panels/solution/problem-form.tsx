import { Button, Select, Text } from "@mantine/core";
import { useMemo, useState } from "react";
import { setUpProblem, solveInCycles } from "../../commands/solution-actions";
import type { CycleSettings } from "../../session/adaptation";
import { setupIn, withAxis, type ProblemSetup } from "../../session/problem-setup";
import type { ProblemKind } from "../../solve/problem";
import { solutionStrings as texts } from "../../strings/solution";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberRow } from "../../ui/fields/number-row";
import { PositionRow } from "../../ui/fields/position-row";
import { SectionTitle } from "../../ui/frames/section-title";
import { useApp, useProject, useRun } from "../shared/app-context";
import { aboveZero } from "../shared/size-fields";
import { ConditionList, type SetupProps } from "./condition-list";
import styles from "./solution.module.css";

const kinds: readonly ProblemKind[] = ["heat", "elasticity", "advection"];

/** States a problem, and solves it once or in cycles. */
export function ProblemForm() {
  const app = useApp();
  const project = useProject();
  const setup = useMemo(() => setupIn(project), [project]);
  const change = (part: Partial<ProblemSetup>): void => setUpProblem(app, { ...setup, ...part });
  return (
    <section aria-label={texts.problem}>
      <SectionTitle>{texts.problem}</SectionTitle>
      <FieldRow label={texts.kind}>
        <Select
          size="xs"
          aria-label={texts.kind}
          data-testid="problem-kind"
          allowDeselect={false}
          data={kinds.map((kind) => ({ value: kind, label: texts.kinds[kind] }))}
          value={setup.kind}
          onChange={(value) => change({ kind: kinds.find((kind) => kind === value) ?? setup.kind })}
        />
      </FieldRow>
      <MaterialFields setup={setup} onChange={change} />
      <SectionTitle>{texts.conditions}</SectionTitle>
      <ConditionList setup={setup} onChange={change} />
      <SolveButtons />
    </section>
  );
}

const withinPoisson = (value: number): string | null =>
  value > -1 && value < 0.5 ? null : texts.poissonRange;

function MaterialFields({ setup, onChange }: SetupProps) {
  if (setup.kind === "elasticity") {
    return (
      <>
        <NumberRow
          label={texts.youngsModulus}
          value={setup.youngsModulus}
          step={1000}
          refuse={aboveZero}
          onCommit={(youngsModulus) => onChange({ youngsModulus })}
        />
        <NumberRow
          label={texts.poissonRatio}
          value={setup.poissonRatio}
          step={0.01}
          refuse={withinPoisson}
          onCommit={(poissonRatio) => onChange({ poissonRatio })}
        />
      </>
    );
  }
  return (
    <>
      {setup.kind === "heat" ? (
        <NumberRow
          label={texts.conductivity}
          value={setup.conductivity}
          step={0.1}
          refuse={aboveZero}
          onCommit={(conductivity) => onChange({ conductivity })}
        />
      ) : (
        <>
          <NumberRow
            label={texts.diffusivity}
            value={setup.diffusivity}
            step={0.01}
            refuse={aboveZero}
            onCommit={(diffusivity) => onChange({ diffusivity })}
          />
          <PositionRow
            label={texts.velocity}
            value={setup.velocity}
            step={0.1}
            testId="velocity"
            onCommit={(axis, value) => onChange({ velocity: withAxis(setup.velocity, axis, value) })}
          />
        </>
      )}
      <NumberRow
        label={texts.source}
        value={setup.source}
        step={0.1}
        onCommit={(source) => onChange({ source })}
      />
      <Text size="xs" c="dimmed">
        {texts.sourceHint}
      </Text>
    </>
  );
}

const whole =
  (low: number, high: number, text: string) =>
  (value: number): string | null =>
    Number.isInteger(value) && value >= low && value <= high ? null : text;

/** Cycles and elements of a run that the user has not chosen. */
const usual: CycleSettings = { cycles: 5, elements: 20_000, norm: "l2" };

function SolveButtons() {
  const app = useApp();
  const [settings, setSettings] = useState(usual);
  const busy = useRun((state) => state.busy);
  return (
    <>
      <div className={styles["buttons"]}>
        <Button
          size="compact-sm"
          variant="default"
          data-testid="solve"
          disabled={busy}
          onClick={() => void solveInCycles(app, { ...settings, cycles: 0 })}
        >
          {texts.solve}
        </Button>
      </div>
      <NumberRow
        label={texts.cycles}
        value={settings.cycles}
        step={1}
        refuse={whole(1, 20, texts.wholeCycles)}
        testId="cycle-count"
        onCommit={(cycles) => setSettings((before) => ({ ...before, cycles }))}
      />
      <NumberRow
        label={texts.elements}
        value={settings.elements}
        step={1000}
        refuse={whole(100, 2_000_000, texts.wholeElements)}
        testId="cycle-elements"
        onCommit={(elements) => setSettings((before) => ({ ...before, elements }))}
      />
      <Text size="xs" c="dimmed">
        {texts.cyclesHint}
      </Text>
      <div className={styles["buttons"]}>
        <Button
          size="compact-sm"
          data-testid="run-cycles"
          disabled={busy}
          onClick={() => void solveInCycles(app, settings)}
        >
          {texts.run(settings.cycles)}
        </Button>
      </div>
    </>
  );
}
