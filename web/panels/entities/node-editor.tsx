import { LIMITS } from "tetrafront";
import type { Project, ProjectBackgroundNode } from "tetrafront/project";
import { moveEntity } from "../../document/edits";
import { expressionOf, keepingExpression } from "../../document/expression-edits";
import { setNodeDirection, setNodeSize, setNodeStretching } from "../../document/size-edits";
import { NumberRow } from "../../ui/fields/number-row";
import { PositionRow } from "../../ui/fields/position-row";
import { Unit } from "../../ui/fields/unit";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { aboveZero, atLeastOne, sizeStep, stepFor, unitsOf, upTo } from "../shared/size-fields";
import { positionExpressions } from "../shared/kept-expressions";
import { useOwnNumbers } from "./use-own-numbers";

interface NodeEditorProps {
  readonly node: ProjectBackgroundNode;
  readonly project: Project;
}

/** The size, stretching and position of a background node. */
export function NodeEditor({ node, project }: NodeEditorProps) {
  const { documents } = useApp();
  const { id, size, stretching = 1, direction = [1, 0, 0] as const, position } = node;
  const own = useOwnNumbers(project, [{ kind: "background-node", id }]);
  const path = (field: string) => ({ kind: "background-node", id, field }) as const;
  const refuseZero = (axis: 0 | 1 | 2, value: number): string | null =>
    direction.with(axis, value).every((x) => x === 0) ? strings.fields.zeroDirection : null;
  return (
    <>
      <NumberRow
        label={strings.inspector.size}
        value={size}
        step={sizeStep(size)}
        refuse={upTo(LIMITS.length, aboveZero)}
        testId="node-size"
        {...unitsOf(project)}
        expression={expressionOf(project, path("size"))}
        own={own("size")}
        onCommit={(value, expression) =>
          documents.edit(keepingExpression(setNodeSize(id, value), path("size"), expression))
        }
      />
      <NumberRow
        label={strings.inspector.stretching}
        value={stretching}
        step={0.1}
        refuse={upTo(LIMITS.stretching, atLeastOne)}
        testId="node-stretching"
        rightSection={<Unit>×</Unit>}
        expression={expressionOf(project, path("stretching"))}
        own={own("stretching")}
        onCommit={(value, expression) =>
          documents.edit(keepingExpression(setNodeStretching(id, value), path("stretching"), expression))
        }
      />
      {stretching !== 1 && (
        <PositionRow
          label={strings.inspector.direction}
          value={direction}
          step={0.1}
          refuse={refuseZero}
          testId="direction"
          expressions={positionExpressions(project, path("direction"))}
          onCommit={(axis, value, expression) =>
            documents.edit(
              keepingExpression(setNodeDirection(id, axis, value), path(`direction.${axis}`), expression),
            )
          }
        />
      )}
      <PositionRow
        label={strings.inspector.position}
        value={position}
        step={stepFor(project)}
        own={(axis) => own(`position.${axis}`)}
        testId="position"
        expressions={positionExpressions(project, path("position"))}
        onCommit={(axis, value, expression) =>
          documents.edit(
            keepingExpression(
              moveEntity("background-node", id, axis, value),
              path(`position.${axis}`),
              expression,
            ),
          )
        }
      />
    </>
  );
}
