import { LIMITS, type ProjectMeshing } from "tetrafront";
import { setMeshing } from "../../document/size-edits";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberField } from "../../ui/fields/number-field";
import { strings } from "../../strings";
import { useApp, useProject } from "../shared/app-context";
import { ChoiceSetting, SettingHint } from "./choice-setting";
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
      <ChoiceSetting
        label={texts.order}
        values={orders}
        value={order}
        labelOf={(value) => texts.orders[value]}
        hint={texts.orderHints[order]}
        onChange={(value) => set("order", value)}
      />
      <ChoiceSetting
        label={texts.optimization}
        values={optimizations}
        value={optimization}
        labelOf={(value) => <span title={texts.optimizations[value]}>{optimizations.indexOf(value)}</span>}
        hint={`${texts.optimizations[optimization]}: ${texts.optimizationHints[optimization]}`}
        onChange={(value) => set("optimization", value)}
      />
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
      <SettingHint>{texts.gradationHint}</SettingHint>
      <ChoiceSetting
        label={texts.innerShells}
        values={innerShellModes}
        value={innerShells}
        labelOf={(value) => texts.innerShellModes[value]}
        hint={texts.innerShellHints[innerShells]}
        onChange={(value) => set("innerShells", value)}
      />
    </details>
  );
}
