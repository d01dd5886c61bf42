import { LIMITS } from "tetrafront";
import type { Project, ProjectBackgroundNode } from "tetrafront/project";
import { moveEntity } from "../../document/edits";
import { expressionOf, keepingExpression } from "../../document/expression-edits";
import {
  setNodeDirection,
  setNodeSecondDirection,
  setNodeSecondStretching,
  setNodeSize,
  setNodeStretching,
} from "../../document/size-edits";
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

const zeroRefusal =
  (direction: readonly number[]) =>
  (axis: 0 | 1 | 2, value: number): string | null =>
    direction.with(axis, value).every((x) => x === 0) ? strings.fields.zeroDirection : null;

/** The size, stretchings and position of a background node. */
export function NodeEditor({ node, project }: NodeEditorProps) {
  const { documents } = useApp();
  const { id, size, stretching = 1, secondStretching = 1, direction = [1, 0, 0] as const, position } = node;
  const own = useOwnNumbers(project, [{ kind: "background-node", id }]);
  const path = (field: string) => ({ kind: "background-node", id, field }) as const;
  const refuseZero = zeroRefusal(direction);
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
      {(stretching !== 1 || secondStretching !== 1) && (
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
      {(stretching !== 1 || secondStretching !== 1) && <SecondStretching node={node} project={project} />}
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

function SecondStretching({ node, project }: NodeEditorProps) {
  const { documents } = useApp();
  const { id, secondStretching = 1, secondDirection = [0, 1, 0] as const } = node;
  const path = (field: string) => ({ kind: "background-node", id, field }) as const;
  return (
    <>
      <NumberRow
        label={strings.inspector.secondStretching}
        value={secondStretching}
        step={0.1}
        refuse={upTo(LIMITS.stretching, atLeastOne)}
        testId="node-second-stretching"
        rightSection={<Unit>×</Unit>}
        expression={expressionOf(project, path("secondStretching"))}
        onCommit={(value, expression) =>
          documents.edit(
            keepingExpression(setNodeSecondStretching(id, value), path("secondStretching"), expression),
          )
        }
      />
      {secondStretching !== 1 && (
        <PositionRow
          label={strings.inspector.secondDirection}
          value={secondDirection}
          step={0.1}
          refuse={zeroRefusal(secondDirection)}
          testId="second-direction"
          expressions={positionExpressions(project, path("secondDirection"))}
          onCommit={(axis, value, expression) =>
            documents.edit(
              keepingExpression(
                setNodeSecondDirection(id, axis, value),
                path(`secondDirection.${axis}`),
                expression,
              ),
            )
          }
        />
      )}
    </>
  );
}
