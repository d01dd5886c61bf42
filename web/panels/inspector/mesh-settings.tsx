import {
  FRONT_ORDERS,
  INNER_SHELLS,
  INTERIORS,
  LIMITS,
  MESH_DEFAULTS,
  OPTIMIZATIONS,
  type FrontOrder,
  type InnerShells,
  type Interior,
  type Optimization,
} from "tetrafront";
import type { ProjectMeshing } from "tetrafront/project";
import { setMeshing } from "../../document/size-edits";
import { NumberRow } from "../../ui/fields/number-row";
import { strings } from "../../strings";
import { useApp, useProject } from "../shared/app-context";
import { ChoiceSetting, SettingHint } from "./choice-setting";
import { useEditedSetting } from "../shared/use-edited-setting";
import styles from "./mesh-settings.module.css";

const texts = strings.meshing;

/** Settings of a project apart from its sizes. */
type Setting = Exclude<keyof ProjectMeshing, "size" | "elements">;

const refuseGradation = (value: number): string | null =>
  value === 0 || (value > 1 && value <= LIMITS.gradation) ? null : texts.invalidGradation;

/** The other orders are for comparison: they make poorer meshes. */
const isForUse = (order: FrontOrder): boolean => order === "layered" || order === "smallest-first";

/** How the mesh is made, apart from its sizes. Kept in the project file. */
export function MeshSettings() {
  const app = useApp();
  const { meshing } = useProject();
  const gradationField = useEditedSetting("gradation");
  const order: FrontOrder = meshing?.order ?? MESH_DEFAULTS.order;
  const optimization: Optimization = meshing?.optimization ?? MESH_DEFAULTS.optimization;
  const interior: Interior = meshing?.interior ?? MESH_DEFAULTS.interior;
  const gradation = meshing?.gradation ?? MESH_DEFAULTS.gradation;
  const innerShells: InnerShells = meshing?.innerShells ?? MESH_DEFAULTS.innerShells;
  // The file omits settings that equal their default.
  const set = <Field extends Setting>(field: Field, value: NonNullable<ProjectMeshing[Field]>): void =>
    app.documents.edit(setMeshing(field, value === MESH_DEFAULTS[field] ? null : value));
  return (
    <details className={styles["settings"]} data-testid="mesh-settings">
      <summary>
        {texts.title}
        <span>{[texts.orders[order], texts.optimizations[optimization]].join(", ").toLowerCase()}</span>
      </summary>
      <ChoiceSetting
        label={texts.order}
        values={FRONT_ORDERS.filter((value) => isForUse(value) || value === order)}
        value={order}
        labelOf={(value) => texts.orders[value]}
        hint={texts.orderHints[order]}
        onChange={(value) => set("order", value)}
      />
      <ChoiceSetting
        label={texts.optimization}
        values={OPTIMIZATIONS}
        value={optimization}
        // The label is the level of effort: the values are in this order.
        labelOf={(value) => <span title={texts.optimizations[value]}>{OPTIMIZATIONS.indexOf(value)}</span>}
        hint={`${texts.optimizations[optimization]}: ${texts.optimizationHints[optimization]}`}
        onChange={(value) => set("optimization", value)}
      />
      <ChoiceSetting
        label={texts.interior}
        values={INTERIORS}
        value={interior}
        labelOf={(value) => texts.interiors[value]}
        hint={texts.interiorHints[interior]}
        onChange={(value) => set("interior", value)}
      />
      <div ref={gradationField}>
        <NumberRow
          label={texts.gradation}
          value={gradation}
          step={0.05}
          refuse={refuseGradation}
          testId="gradation"
          onCommit={(value) => set("gradation", value)}
        />
      </div>
      <SettingHint>{texts.gradationHint}</SettingHint>
      <ChoiceSetting
        label={texts.innerShells}
        values={INNER_SHELLS}
        value={innerShells}
        labelOf={(value) => texts.innerShellModes[value]}
        hint={texts.innerShellHints[innerShells]}
        onChange={(value) => set("innerShells", value)}
      />
    </details>
  );
}
