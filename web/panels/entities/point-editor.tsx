import type { Project, ProjectPoint } from "tetrafront/project";
import { moveEntity } from "../../document/edits";
import { keepingExpression } from "../../document/expression-edits";
import { PositionRow } from "../../ui/fields/position-row";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { stepFor } from "../shared/size-fields";
import { positionExpressions } from "../shared/kept-expressions";
import { useOwnNumbers } from "./use-own-numbers";

/** The position of a point. */
export function PointEditor({ point, project }: { readonly point: ProjectPoint; readonly project: Project }) {
  const app = useApp();
  const own = useOwnNumbers(project, [{ kind: "point", id: point.id }]);
  const path = { kind: "point", id: point.id, field: "position" } as const;
  return (
    <PositionRow
      label={strings.inspector.position}
      value={point.position}
      step={stepFor(project)}
      own={(axis) => own(`position.${axis}`)}
      testId="position"
      expressions={positionExpressions(project, path)}
      onCommit={(axis, value, expression) =>
        app.documents.edit(
          keepingExpression(
            moveEntity("point", point.id, axis, value),
            { ...path, field: `position.${axis}` },
            expression,
          ),
        )
      }
    />
  );
}
