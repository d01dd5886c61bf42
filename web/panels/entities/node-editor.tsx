import { LIMITS, type Project, type ProjectBackgroundNode } from "tetrafront";
import { moveEntity } from "../../document/edits";
import { setNodeDirection, setNodeSize, setNodeStretching } from "../../document/size-edits";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberField } from "../../ui/fields/number-field";
import { PositionFields } from "../../ui/fields/position-fields";
import { strings } from "../../strings";
import { Unit } from "../../ui/fields/unit";
import { useApp } from "../shared/app-context";
import { aboveZero, atLeastOne, sizeStep, stepFor, unitsOf, upTo } from "../shared/size-fields";

interface NodeEditorProps {
  readonly node: ProjectBackgroundNode;
  readonly project: Project;
}

/** The size, stretching and position of a background node. */
export function NodeEditor({ node, project }: NodeEditorProps) {
  const app = useApp();
  const direction = node.direction ?? [1, 0, 0];
  const stretching = node.stretching ?? 1;
  const refuseZero = (axis: 0 | 1 | 2, value: number): string | null =>
    direction.with(axis, value).every((x) => x === 0) ? strings.fields.zeroDirection : null;
  return (
    <>
      <FieldRow label={strings.inspector.size}>
        <NumberField
          key={node.id}
          label={strings.inspector.size}
          value={node.size}
          step={sizeStep(node.size)}
          refuse={upTo(LIMITS.length, aboveZero)}
          testId="node-size"
          {...unitsOf(project)}
          onCommit={(value) => app.documents.edit(setNodeSize(node.id, value))}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.stretching}>
        <NumberField
          key={node.id}
          label={strings.inspector.stretching}
          value={stretching}
          step={0.1}
          refuse={upTo(LIMITS.stretching, atLeastOne)}
          testId="node-stretching"
          rightSection={<Unit>×</Unit>}
          onCommit={(value) => app.documents.edit(setNodeStretching(node.id, value))}
        />
      </FieldRow>
      {stretching !== 1 && (
        <FieldRow label={strings.inspector.direction}>
          <PositionFields
            key={node.id}
            label={strings.inspector.direction}
            value={direction}
            step={0.1}
            refuse={refuseZero}
            testId="direction"
            onCommit={(axis, value) => app.documents.edit(setNodeDirection(node.id, axis, value))}
          />
        </FieldRow>
      )}
      <FieldRow label={strings.inspector.position}>
        <PositionFields
          key={node.id}
          label={strings.inspector.position}
          value={node.position}
          step={stepFor(project)}
          testId="position"
          onCommit={(axis, value) => app.documents.edit(moveEntity("background-node", node.id, axis, value))}
        />
      </FieldRow>
    </>
  );
}
