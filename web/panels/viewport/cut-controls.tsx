import { SegmentedControl, Slider } from "@mantine/core";
import type { CutAxis } from "../../document/selection";
import { strings } from "../../strings";
import { useApp, useView } from "../shared/app-context";

const axes: readonly CutAxis[] = ["x", "y", "z"];

export function CutAxisControl() {
  const app = useApp();
  const axis = useView((state) => state.cut.axis);
  return (
    <SegmentedControl
      size="xs"
      aria-label={strings.display.cutAxis}
      data={[...axes]}
      value={axis}
      onChange={(value) => app.view.cutAcross(value)}
    />
  );
}

/** Step of the slider / extent of the model. */
const sliderStep = 0.005;

export function CutSlider() {
  const app = useApp();
  const { position, enabled } = useView((state) => state.cut);
  return (
    <Slider
      size="sm"
      min={0}
      max={1}
      step={sliderStep}
      label={null}
      disabled={!enabled}
      thumbLabel={strings.display.cutPosition}
      value={position}
      onChange={(value) => app.view.setCut({ position: value })}
    />
  );
}
