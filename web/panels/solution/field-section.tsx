import { Button, Select } from "@mantine/core";
import { useStore } from "zustand";
import { firstChoice } from "../../session/adaptation";
import { chosenField, type FieldChoice, type MeshField } from "../../session/solutions";
import { solutionStrings as texts } from "../../strings/solution";
import { FieldRow } from "../../ui/fields/field-row";
import { SectionTitle } from "../../ui/frames/section-title";
import { useApp, useRun, useStale } from "../shared/app-context";
import { ShapeControls } from "./shape-controls";

/** Entry of the list that stands for no field; the others are indices. */
const none = "none";

/** Chooses what the view shows of the fields of the shown mesh. */
export function FieldSection() {
  const app = useApp();
  const { solutions } = app;
  const { meshes, at, choice } = useStore(solutions.state);
  const busy = useRun((state) => state.busy);
  const stale = useStale();
  const fields = meshes[at ?? meshes.length - 1]?.fields ?? [];
  const field = chosenField(fields, choice);
  return (
    <section aria-label={texts.field}>
      <SectionTitle>{texts.field}</SectionTitle>
      <FieldRow label={texts.field}>
        <Select
          size="xs"
          aria-label={texts.field}
          data-testid="field"
          allowDeselect={false}
          data={[
            { value: none, label: texts.noField },
            ...fields.map(({ name, isPerElement }, index) => ({
              value: String(index),
              label: isPerElement === true ? texts.ofElements(name) : name,
            })),
          ]}
          value={field ? String(fields.indexOf(field)) : none}
          onChange={(value) => {
            const chosen = fields[Number(value)];
            solutions.choose(chosen ? firstChoice(chosen) : null);
          }}
        />
      </FieldRow>
      {field && choice && field.components > 1 && <ComponentChoice field={field} choice={choice} />}
      <ShapeControls />
      <Button
        size="compact-sm"
        variant="default"
        mt={4}
        data-testid="adapt-to-field"
        disabled={!field || busy || stale || at === null}
        onClick={() => app.shell.setState({ dialog: "adapt" })}
      >
        {texts.adapt}
      </Button>
    </section>
  );
}

interface ComponentChoiceProps {
  readonly field: MeshField;
  readonly choice: FieldChoice;
}

function ComponentChoice({ field, choice }: ComponentChoiceProps) {
  const { name, components, isPerElement } = field;
  const { solutions } = useApp();
  const label = (index: number): string =>
    components === 3 ? (texts.axes[index] ?? "") : texts.number(index);
  const data = Array.from({ length: components }, (_, index) => ({
    value: String(index),
    label: label(index),
  }));
  return (
    <FieldRow label={texts.component}>
      <Select
        size="xs"
        aria-label={texts.component}
        data-testid="field-component"
        allowDeselect={false}
        data={[{ value: "magnitude", label: texts.magnitude }, ...data]}
        value={String(choice.component)}
        onChange={(value) =>
          solutions.choose(
            value === null || value === "magnitude"
              ? firstChoice(field)
              : {
                  name,
                  component: Number(value),
                  label: texts.choice(name, label(Number(value))),
                  isPerElement,
                },
          )
        }
      />
    </FieldRow>
  );
}
