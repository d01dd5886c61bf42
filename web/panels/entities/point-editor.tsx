import type { Project, ProjectPoint } from "tetrafront";
import { moveEntity } from "../../document/edits";
import { PositionRow } from "../../ui/fields/position-row";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { stepFor } from "../shared/size-fields";

/** The position of a point. */
export function PointEditor({ point, project }: { readonly point: ProjectPoint; readonly project: Project }) {
  const app = useApp();
  return (
    <PositionRow
      label={strings.inspector.position}
      value={point.position}
      step={stepFor(project)}
      testId="position"
      onCommit={(axis, value) => app.documents.edit(moveEntity("point", point.id, axis, value))}
    />
  );
}
