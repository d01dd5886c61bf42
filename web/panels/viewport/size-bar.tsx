import { SegmentedControl, Slider, Switch } from "@mantine/core";
import type { CutAxis } from "../../document/selection";
import { strings } from "../../strings";
import { useApp, useView } from "../shared/app-context";
import styles from "./viewport-overlays.module.css";

const texts = strings.background;
const axes: readonly CutAxis[] = ["x", "y", "z"];
/** Step of the slider / extent of the model. */
const sliderStep = 0.005;

/** The target sizes in the view: on or off, and the plane on which they are shown. */
export function SizeBar() {
  const app = useApp();
  const { enabled, plane } = useView((state) => state.sizes);
  return (
    <div
      className={styles["cutBar"]}
      role="group"
      aria-label={texts.showSizes}
      data-testid="size-bar"
      data-presented
    >
      <Switch
        size="xs"
        label={texts.showSizes}
        checked={enabled}
        onChange={(event) => app.view.setSizes({ enabled: event.currentTarget.checked })}
      />
      <SegmentedControl
        size="xs"
        aria-label={texts.sizePlane}
        data={[
          { value: "none", label: texts.noPlane },
          ...axes.map((axis) => ({ value: axis, label: axis })),
        ]}
        value={plane?.axis ?? "none"}
        onChange={(value) => {
          const axis = axes.find((one) => one === value);
          app.view.setSizes({ plane: axis ? { axis, position: plane?.position ?? 0.5 } : null });
        }}
      />
      {plane && (
        <Slider
          size="sm"
          min={0}
          max={1}
          step={sliderStep}
          label={null}
          thumbLabel={texts.sizePlanePosition}
          value={plane.position}
          onChange={(position) => app.view.setSizes({ plane: { ...plane, position } })}
        />
      )}
    </div>
  );
}
