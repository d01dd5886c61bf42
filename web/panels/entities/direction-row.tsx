import type { Project, ProjectBackgroundNode } from "tetrafront/project";
import { defaultDirections, setDirections, type DirectionField } from "../../document/node-directions";
import { PositionRow } from "../../ui/fields/position-row";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { positionExpressions } from "../shared/kept-expressions";

interface DirectionRowProps {
  /** At least one. */
  readonly nodes: readonly ProjectBackgroundNode[];
  readonly field: DirectionField;
  readonly project: Project;
  readonly testId: string;
}

const axes = [0, 1, 2] as const;

/** A direction of one or several background nodes; a change applies to all of them. */
export function DirectionRow({ nodes, field, project, testId }: DirectionRowProps) {
  const { documents } = useApp();
  const directions = nodes.map((node) => node[field] ?? defaultDirections[field]);
  const [first = defaultDirections[field]] = directions;
  const ids = nodes.map(({ id }) => id);
  const [id = 0, ...others] = ids;
  const common = (axis: 0 | 1 | 2): number | null =>
    directions.every((direction) => direction[axis] === first[axis]) ? first[axis] : null;
  const refuse = (axis: 0 | 1 | 2, value: number): string | null =>
    directions.some((direction) => direction.with(axis, value).every((x) => x === 0))
      ? strings.fields.zeroDirection
      : null;
  const isOrthogonal = field === "secondDirection" && nodes.some(({ direction }) => direction);
  return (
    <PositionRow
      label={strings.inspector[field]}
      hint={isOrthogonal ? strings.fields.keptOrthogonal : null}
      value={[common(0), common(1), common(2)]}
      step={0.1}
      refuse={refuse}
      testId={testId}
      expressions={
        others.length > 0
          ? axes.map(() => undefined)
          : positionExpressions(project, { kind: "background-node", id, field })
      }
      onCommit={(axis, value, expression) =>
        documents.edit(setDirections(project, ids, field, { axis, value, expression }))
      }
    />
  );
}
