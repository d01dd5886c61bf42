import { Slider, Switch } from "@mantine/core";
import { useStore } from "zustand";
import { showFieldShapes } from "../../commands/solution-actions";
import { displacementsIn, vectorField, type FieldShapes } from "../../session/solutions";
import { formatShort } from "../../strings/format";
import { solutionStrings as texts } from "../../strings/solution";
import { useApp } from "../shared/app-context";

/** Number of values at which lines are drawn. */
const lineCount = 16;

/** What else the view shows of the chosen field: lines, an isosurface, arrows, the deformed shape. */
export function ShapeControls() {
  const app = useApp();
  const { solutions } = app;
  const { meshes, at, choice, lines, shapes, shown } = useStore(solutions.state);
  const solved = at === null ? undefined : meshes[at];
  const toggle = (name: keyof FieldShapes, label: string, isOffered: boolean) =>
    isOffered && (
      <Switch
        size="xs"
        my={6}
        label={label}
        checked={shapes[name] !== null && shapes[name] !== false}
        disabled={!shown}
        data-testid={`field-${name}`}
        onChange={({ currentTarget: { checked } }) =>
          showFieldShapes(app, { [name]: name === "isosurface" ? (checked ? 0.5 : null) : checked })
        }
      />
    );
  // Colours of elements are flat: no line or surface has one value.
  const isContinuous = shown?.isPerElement !== true;
  const deformed = shown?.offsets ? texts.deformedBy(shown.enlargement) : texts.deformed;
  return (
    <>
      {isContinuous && (
        <Switch
          size="xs"
          my={6}
          label={texts.lines}
          checked={lines > 0}
          disabled={!shown}
          data-testid="field-lines"
          onChange={(event) => solutions.setLines(event.currentTarget.checked ? lineCount : 0)}
        />
      )}
      {toggle("isosurface", texts.isosurface, isContinuous)}
      {shapes.isosurface !== null && shown && isContinuous && (
        <IsosurfaceSlider at={shapes.isosurface} range={shown.range} />
      )}
      {toggle("arrows", texts.arrows, solved !== undefined && vectorField(solved, choice) !== undefined)}
      {toggle("deformed", deformed, solved !== undefined && displacementsIn(solved) !== undefined)}
    </>
  );
}

interface IsosurfaceSliderProps {
  readonly at: number;
  readonly range: readonly [low: number, high: number];
}

function IsosurfaceSlider({ at, range: [low, high] }: IsosurfaceSliderProps) {
  const app = useApp();
  const text = formatShort(low + at * (high - low));
  return (
    <Slider
      size="xs"
      my={8}
      mx={6}
      min={0}
      max={1}
      step={0.01}
      value={at}
      label={text}
      thumbLabel={texts.isosurfaceAt}
      data-testid="isosurface-value"
      onChange={(isosurface) => showFieldShapes(app, { isosurface })}
    />
  );
}
