import { Select, Text } from "@mantine/core";
import { IconX } from "@tabler/icons-react";
import { useMemo } from "react";
import { patchNames } from "tetrafront/internal";
import {
  conditionKinds,
  defaultCondition,
  withAxis,
  type PatchCondition,
  type ProblemSetup,
} from "../../session/problem-setup";
import type { ProblemKind } from "../../solve/problem";
import { solutionStrings as texts } from "../../strings/solution";
import { NumberField } from "../../ui/fields/number-field";
import { PositionFields } from "../../ui/fields/position-fields";
import { IconButton } from "../../ui/icon-button";
import { useProject } from "../shared/app-context";
import styles from "./solution.module.css";

export interface SetupProps {
  readonly setup: ProblemSetup;
  readonly onChange: (part: Partial<ProblemSetup>) => void;
}

/** The conditions of a problem, one per patch. */
export function ConditionList({ setup, onChange }: SetupProps) {
  const { kind } = setup;
  const known = conditionKinds(kind);
  const isKnown = (condition: PatchCondition): boolean => known.includes(condition.kind);
  const conditions = setup.conditions.filter(isKnown);
  // Those of other kinds of problems stay for when the user goes back.
  const others = setup.conditions.filter((condition) => !isKnown(condition));
  const names = usePatchNames();
  const free = names.filter((name) => !conditions.some(({ patch }) => patch === name));
  const set = (changed: readonly PatchCondition[]): void => onChange({ conditions: [...others, ...changed] });
  return (
    <>
      {conditions.length === 0 && (
        <Text size="xs" c="dimmed" mb={6}>
          {texts.noConditions[kind]}
        </Text>
      )}
      {conditions.map((condition) => (
        <ConditionRow
          key={condition.patch}
          kind={kind}
          condition={condition}
          onChange={(part) => set(conditions.map((one) => (one === condition ? { ...one, ...part } : one)))}
          onRemove={() => set(conditions.filter((one) => one !== condition))}
        />
      ))}
      <Select
        size="xs"
        searchable
        aria-label={texts.addLabel}
        placeholder={texts.add}
        data-testid="add-condition"
        disabled={free.length === 0}
        data={free}
        value={null}
        onChange={(name) => name !== null && set([...conditions, defaultCondition(kind, name)])}
      />
    </>
  );
}

interface ConditionRowProps {
  readonly kind: ProblemKind;
  readonly condition: PatchCondition;
  readonly onChange: (part: Partial<PatchCondition>) => void;
  readonly onRemove: () => void;
}

function ConditionRow({ kind, condition, onChange, onRemove }: ConditionRowProps) {
  const { patch } = condition;
  const known = conditionKinds(kind);
  return (
    <div className={styles["condition"]} role="group" aria-label={texts.conditionOn(patch)}>
      <strong title={patch}>{patch}</strong>
      <IconButton label={texts.remove(patch)} size={24} onClick={onRemove}>
        <IconX size={14} aria-hidden />
      </IconButton>
      <div>
        <Select
          size="xs"
          aria-label={texts.conditionOn(patch)}
          allowDeselect={false}
          data={known.map((value) => ({ value, label: texts.conditionKinds[kind][value] }))}
          value={condition.kind}
          onChange={(value) => onChange({ kind: known.find((one) => one === value) ?? condition.kind })}
        />
        {(condition.kind === "value" || condition.kind === "flux") && (
          <NumberField
            label={texts.valueOn(patch)}
            value={condition.value}
            step={1}
            onCommit={(value) => onChange({ value })}
          />
        )}
      </div>
      {condition.kind === "traction" && (
        <div>
          <PositionFields
            label={texts.tractionOn(patch)}
            value={condition.traction}
            step={1}
            testId="traction"
            onCommit={(axis, value) => onChange({ traction: withAxis(condition.traction, axis, value) })}
          />
        </div>
      )}
    </div>
  );
}

/** The names of the patches of the model; each once. */
function usePatchNames(): readonly string[] {
  const project = useProject();
  return useMemo(() => [...new Set(patchNames(project))], [project]);
}
