import { LIMITS } from "tetrafront";
import type { Project, ProjectBackgroundNode } from "tetrafront/project";
import { moveEntity } from "../../document/edits";
import { expressionOf, keepingExpression } from "../../document/expression-edits";
import { setNodeSecondStretching, setNodeSize, setNodeStretching } from "../../document/size-edits";
import { NumberRow } from "../../ui/fields/number-row";
import { PositionRow } from "../../ui/fields/position-row";
import { Unit } from "../../ui/fields/unit";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { aboveZero, atLeastOne, sizeStep, stepFor, unitsOf, upTo } from "../shared/size-fields";
import { positionExpressions } from "../shared/kept-expressions";
import { DirectionRow } from "./direction-row";
import { useOwnNumbers } from "./use-own-numbers";

interface NodeEditorProps {
  readonly node: ProjectBackgroundNode;
  readonly project: Project;
}

/** The size, stretchings and position of a background node. */
export function NodeEditor({ node, project }: NodeEditorProps) {
  const { documents } = useApp();
  const { id, size, stretching = 1, secondStretching = 1, position } = node;
  const own = useOwnNumbers(project, [{ kind: "background-node", id }]);
  const path = (field: string) => ({ kind: "background-node", id, field }) as const;
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
        <DirectionRow nodes={[node]} field="direction" project={project} testId="direction" />
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
  const { id, secondStretching = 1 } = node;
  const own = useOwnNumbers(project, [{ kind: "background-node", id }]);
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
        own={own("secondStretching")}
        onCommit={(value, expression) =>
          documents.edit(
            keepingExpression(setNodeSecondStretching(id, value), path("secondStretching"), expression),
          )
        }
      />
      {secondStretching !== 1 && (
        <DirectionRow nodes={[node]} field="secondDirection" project={project} testId="second-direction" />
      )}
    </>
  );
}
