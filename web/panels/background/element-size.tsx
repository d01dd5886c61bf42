import { LIMITS } from "tetrafront";
import { Group, SegmentedControl, Switch, Text } from "@mantine/core";
import { setUniform } from "../../commands/background-actions";
import { expressionOf, keepingExpression } from "../../document/expression-edits";
import { uniformSizePath } from "../../document/number-paths";
import { setMeshing } from "../../document/size-edits";
import { FieldRow } from "../../ui/fields/field-row";
import { formatCount } from "../../strings/format";
import { NumberField } from "../../ui/fields/number-field";
import { strings } from "../../strings";
import { useApp, useProject, useView } from "../shared/app-context";
import { TextCommandButton } from "../shared/command-button";
import { useEditedSetting } from "../shared/use-edited-setting";
import { aboveZero, sizeStep, unitsOf, upTo } from "../shared/size-fields";
import { ElementCount } from "../shared/element-count";
import { SectionTitle } from "../../ui/frames/section-title";

const texts = strings.background;

/** The source of the element sizes, and the commands that create sizes. */
export function ElementSize() {
  const app = useApp();
  const uniformSize = useProject().meshing?.size;
  const sizeField = useEditedSetting("uniform-size");
  return (
    <section aria-label={texts.elementSize} data-testid="element-size">
      <SectionTitle>{texts.elementSize}</SectionTitle>
      <div ref={sizeField}>
        <SegmentedControl
          size="xs"
          fullWidth
          mb={8}
          aria-label={texts.elementSize}
          data={[
            { value: "grid", label: texts.fromGrid },
            { value: "uniform", label: texts.uniform },
          ]}
          value={uniformSize === undefined ? "grid" : "uniform"}
          onChange={(value) => setUniform(app, value === "uniform")}
        />
        {uniformSize === undefined ? <GridCounts /> : <UniformSize size={uniformSize} />}
      </div>
      <ElementCount />
      <Group gap={5}>
        {["cover", "propose"].map((id) => (
          <TextCommandButton size="compact-sm" key={id} command={id} />
        ))}
      </Group>
      <ShowSizes />
    </section>
  );
}

/** Colours the model by the target size before it is meshed. */
function ShowSizes() {
  const app = useApp();
  const enabled = useView((state) => state.sizes.enabled);
  return (
    <Switch
      size="xs"
      mt={8}
      label={texts.showSizes}
      checked={enabled}
      data-testid="show-sizes"
      onChange={(event) => app.view.setSizes({ enabled: event.currentTarget.checked })}
    />
  );
}

function GridCounts() {
  const { nodes, tetrahedra } = useProject().background;
  return (
    <Text size="sm" c="dimmed" mb={6}>
      {nodes.length === 0
        ? texts.noGrid
        : texts.gridCounts(formatCount(nodes.length), formatCount(tetrahedra.length))}
    </Text>
  );
}

function UniformSize({ size }: { readonly size: number }) {
  const app = useApp();
  const project = useProject();
  return (
    <>
      <FieldRow label={strings.inspector.size}>
        <NumberField
          label={texts.uniformSize}
          value={size}
          step={sizeStep(size)}
          refuse={upTo(LIMITS.length, aboveZero)}
          testId="uniform-size"
          {...unitsOf(project)}
          expression={expressionOf(project, uniformSizePath)}
          onCommit={(value, expression) =>
            app.documents.edit(keepingExpression(setMeshing("size", value), uniformSizePath, expression))
          }
        />
      </FieldRow>
      <Text size="xs" c="dimmed" mb={6}>
        {texts.uniformHint}
      </Text>
    </>
  );
}
