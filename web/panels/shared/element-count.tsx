import { Slider, Switch, Text } from "@mantine/core";
import { useState } from "react";
import { MESH_DEFAULTS } from "tetrafront";
import { setMeshing } from "../../document/size-edits";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberField } from "../../ui/fields/number-field";
import { formatCount } from "../../strings/format";
import { strings } from "../../strings";
import { useApp, useProject, useRun } from "./app-context";
import { useEditedSetting } from "./use-edited-setting";
import styles from "./element-count.module.css";

const texts = strings.background;

/** The slider is logarithmic: a step is about 2 %. It ends where a run takes minutes; the field takes more. */
const slider = { min: 2, max: 6, step: 0.01, digits: 2 } as const;
const marks = [2, 3, 4, 5, 6].map((value) => ({ value, label: texts.countMarks[value - 2] }));
const firstCount = 20_000;

const refuse = (value: number): string | null =>
  Number.isInteger(value) && value >= 1 && value <= MESH_DEFAULTS.maxTetrahedra ? null : texts.invalidCount;

const roundCount = (value: number): number => Number(value.toPrecision(slider.digits));

/** The number of elements that the mesh is to have, if it is to decide the sizes. Kept in the project file. */
export function ElementCount() {
  const app = useApp();
  const count = useProject().meshing?.elements;
  const current = useRun(({ mesh }) => mesh?.report.tetrahedra);
  const field = useEditedSetting("elements");
  const turn = (isOn: boolean): void => {
    const start = current !== undefined && current > 0 ? roundCount(current) : firstCount;
    app.documents.edit(setMeshing("elements", isOn ? start : null));
  };
  return (
    <div ref={field} className={styles["count"]} data-testid="element-count">
      <Switch
        size="xs"
        label={texts.reachCount}
        checked={count !== undefined}
        data-testid="element-count-switch"
        onChange={(event) => turn(event.currentTarget.checked)}
      />
      {count !== undefined && <CountFields count={count} />}
    </div>
  );
}

function CountFields({ count }: { readonly count: number }) {
  const app = useApp();
  // While the slider is dragged, the project keeps its number.
  const [dragged, setDragged] = useState<number | null>(null);
  const commit = (value: number): void => {
    setDragged(null);
    app.documents.edit(setMeshing("elements", value));
  };
  const shown = dragged ?? Math.log10(count);
  const numberOf = (value: number): number => roundCount(10 ** value);
  return (
    <>
      <FieldRow label={texts.count}>
        <NumberField
          label={texts.count}
          value={dragged === null ? count : numberOf(dragged)}
          step={Math.max(1, 10 ** Math.floor(Math.log10(count) - 1))}
          refuse={refuse}
          testId="elements"
          onCommit={(value) => commit(value)}
        />
      </FieldRow>
      <Slider
        size="sm"
        className={styles["slider"]}
        min={slider.min}
        max={slider.max}
        step={slider.step}
        marks={marks}
        label={(value) => formatCount(numberOf(value))}
        thumbLabel={texts.count}
        thumbProps={{ "aria-valuetext": formatCount(dragged === null ? count : numberOf(dragged)) }}
        value={Math.min(slider.max, Math.max(slider.min, shown))}
        onChange={setDragged}
        onChangeEnd={(value) => commit(numberOf(value))}
      />
      <Text size="xs" c="dimmed" mb={6}>
        {texts.countHint}
      </Text>
    </>
  );
}
