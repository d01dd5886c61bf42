import { SegmentedControl, Text } from "@mantine/core";
import { LIMITS, type ProjectMeshing } from "tetrafront";
import { setMeshing } from "../../document/size-edits";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberField } from "../../ui/fields/number-field";
import { strings } from "../../strings";
import { useApp, useProject } from "../shared/app-context";
import styles from "./mesh-settings.module.css";

const texts = strings.meshing;

type InnerShells = NonNullable<ProjectMeshing["innerShells"]>;
type Order = NonNullable<ProjectMeshing["order"]>;
type Optimization = NonNullable<ProjectMeshing["optimization"]>;

/** Settings that apply if the project has none. */
const defaults = {
  innerShells: "cavities",
  gradation: 1.3,
  order: "layered",
  optimization: "default",
} as const;

const innerShellModes: readonly InnerShells[] = ["cavities", "regions"];
const orders: readonly Order[] = ["layered", "smallest-first"];
/** In order of effort: levels 0 to 3. */
const optimizations: readonly Optimization[] = ["none", "fast", "default", "thorough"];

const refuseGradation = (value: number): string | null =>
  value === 0 || (value > 1 && value <= LIMITS.gradation) ? null : texts.invalidGradation;

/** How the mesh is made, apart from its sizes. Kept in the project file. */
export function MeshSettings() {
  const app = useApp();
  const { meshing } = useProject();
  const order: Order = meshing?.order ?? defaults.order;
  const optimization: Optimization = meshing?.optimization ?? defaults.optimization;
  const gradation = meshing?.gradation ?? defaults.gradation;
  const innerShells: InnerShells = meshing?.innerShells ?? defaults.innerShells;
  // The file omits settings that equal their default.
  const set = <Field extends keyof typeof defaults>(
    field: Field,
    value: NonNullable<ProjectMeshing[Field]>,
  ): void => app.documents.edit(setMeshing(field, value === defaults[field] ? null : value));
  return (
    <details className={styles["settings"]} data-testid="mesh-settings">
      <summary>
        {texts.title}
        <span>{[texts.orders[order], texts.optimizations[optimization]].join(", ").toLowerCase()}</span>
      </summary>
      <FieldRow label={texts.order}>
        <SegmentedControl<Order>
          size="xs"
          fullWidth
          aria-label={texts.order}
          data={orders.map((value) => ({ value, label: texts.orders[value] }))}
          value={order}
          onChange={(value) => set("order", value)}
        />
      </FieldRow>
      <Text size="xs" c="dimmed" mb={6}>
        {texts.orderHints[order]}
      </Text>
      <FieldRow label={texts.optimization}>
        <SegmentedControl<Optimization>
          size="xs"
          fullWidth
          aria-label={texts.optimization}
          data={optimizations.map((value, level) => ({
            value,
            label: <span title={texts.optimizations[value]}>{level}</span>,
          }))}
          value={optimization}
          onChange={(value) => set("optimization", value)}
        />
      </FieldRow>
      <Text size="xs" c="dimmed" mb={6}>
        {texts.optimizations[optimization]}: {texts.optimizationHints[optimization]}
      </Text>
      <FieldRow label={texts.gradation}>
        <NumberField
          label={texts.gradation}
          value={gradation}
          step={0.05}
          refuse={refuseGradation}
          testId="gradation"
          onCommit={(value) => set("gradation", value)}
        />
      </FieldRow>
      <Text size="xs" c="dimmed" mb={6}>
        {texts.gradationHint}
      </Text>
      <FieldRow label={texts.innerShells}>
        <SegmentedControl<InnerShells>
          size="xs"
          fullWidth
          aria-label={texts.innerShells}
          data={innerShellModes.map((value) => ({ value, label: texts.innerShellModes[value] }))}
          value={innerShells}
          onChange={(value) => set("innerShells", value)}
        />
      </FieldRow>
      <Text size="xs" c="dimmed" mb={6}>
        {texts.innerShellHints[innerShells]}
      </Text>
    </details>
  );
}
