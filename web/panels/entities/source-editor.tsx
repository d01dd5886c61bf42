import { Text } from "@mantine/core";
import { LIMITS, SOURCE_GROWTH, type Project, type ProjectSource } from "tetrafront";
import { moveSource, setSourceField } from "../../document/size-edits";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberField } from "../../ui/fields/number-field";
import { PositionFields } from "../../ui/fields/position-fields";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { aboveZero, notNegative, sizeStep, stepFor, unitsOf, upTo } from "../shared/size-fields";

interface SourceEditorProps {
  readonly source: ProjectSource;
  readonly project: Project;
}

/** The sizes and the corners of a source. */
export function SourceEditor({ source, project }: SourceEditorProps) {
  const app = useApp();
  const { id, size, distance = 0, growth = SOURCE_GROWTH, positions } = source;
  const set = (field: "size" | "distance" | "growth") => (value: number) =>
    app.documents.edit(setSourceField(id, field, value));
  return (
    <>
      <FieldRow label={strings.inspector.size}>
        <NumberField
          key={id}
          label={strings.inspector.size}
          value={size}
          step={sizeStep(size)}
          refuse={upTo(LIMITS.length, aboveZero)}
          testId="source-size"
          {...unitsOf(project)}
          onCommit={set("size")}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.distance}>
        <NumberField
          key={id}
          label={strings.inspector.distance}
          value={distance}
          step={sizeStep(size)}
          refuse={upTo(LIMITS.length, notNegative)}
          testId="source-distance"
          {...unitsOf(project)}
          onCommit={set("distance")}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.growth}>
        <NumberField
          key={id}
          label={strings.inspector.growth}
          value={growth}
          step={0.05}
          refuse={upTo(LIMITS.growth, notNegative)}
          testId="source-growth"
          onCommit={set("growth")}
        />
      </FieldRow>
      {positions.map((position, index) => (
        <FieldRow key={`${id}-${index}`} label={strings.inspector.cornerPosition(index, positions.length)}>
          <PositionFields
            label={strings.inspector.cornerPosition(index, positions.length)}
            value={position}
            step={stepFor(project)}
            testId={`position-${index}`}
            onCommit={(axis, value) => app.documents.edit(moveSource(id, index, axis, value))}
          />
        </FieldRow>
      ))}
      <Text size="sm" c="dimmed">
        {strings.inspector.sourceRule}
      </Text>
    </>
  );
}
