import { Text } from "@mantine/core";
import { LIMITS } from "tetrafront";
import { SOURCE_GROWTH } from "tetrafront/internal";
import type { Project, ProjectSource } from "tetrafront/project";
import { expressionOf, keepingExpression } from "../../document/expression-edits";
import { moveSource, setSourceField } from "../../document/size-edits";
import { NumberRow } from "../../ui/fields/number-row";
import { PositionRow } from "../../ui/fields/position-row";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { aboveZero, notNegative, sizeStep, stepFor, unitsOf, upTo } from "../shared/size-fields";
import { positionExpressions } from "../shared/kept-expressions";

interface SourceEditorProps {
  readonly source: ProjectSource;
  readonly project: Project;
}

/** The sizes and the corners of a source. */
export function SourceEditor({ source, project }: SourceEditorProps) {
  const { documents } = useApp();
  const { id, size, distance = 0, growth = SOURCE_GROWTH, positions } = source;
  const path = (field: string) => ({ kind: "source", id, field }) as const;
  const length = { step: sizeStep(size), ...unitsOf(project) };
  const fields = [
    { name: "size", value: size, refuse: upTo(LIMITS.length, aboveZero), ...length },
    { name: "distance", value: distance, refuse: upTo(LIMITS.length, notNegative), ...length },
    { name: "growth", value: growth, refuse: upTo(LIMITS.growth, notNegative), step: 0.05 },
  ] as const;
  return (
    <>
      {fields.map(({ name, ...field }) => (
        <NumberRow
          key={name}
          label={strings.inspector[name]}
          testId={`source-${name}`}
          expression={expressionOf(project, path(name))}
          onCommit={(value, expression) =>
            documents.edit(keepingExpression(setSourceField(id, name, value), path(name), expression))
          }
          {...field}
        />
      ))}
      {positions.map((position, index) => (
        <PositionRow
          key={index}
          label={strings.inspector.cornerPosition(index, positions.length)}
          value={position}
          step={stepFor(project)}
          testId={`position-${index}`}
          expressions={positionExpressions(project, path(`positions.${index}`))}
          onCommit={(axis, value, expression) =>
            documents.edit(
              keepingExpression(
                moveSource(id, index, axis, value),
                path(`positions.${index}.${axis}`),
                expression,
              ),
            )
          }
        />
      ))}
      <Text size="sm" c="dimmed">
        {strings.inspector.sourceRule}
      </Text>
    </>
  );
}
