import type { Project, ProjectPoint } from "tetrafront";
import { moveEntity } from "../../document/edits";
import { FieldRow } from "../../ui/fields/field-row";
import { PositionFields } from "../../ui/fields/position-fields";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { stepFor } from "../shared/size-fields";

/** The position of a point. */
export function PointEditor({ point, project }: { readonly point: ProjectPoint; readonly project: Project }) {
  const app = useApp();
  return (
    <FieldRow label={strings.inspector.position}>
      <PositionFields
        key={point.id}
        label={strings.inspector.position}
        value={point.position}
        step={stepFor(project)}
        testId="position"
        onCommit={(axis, value) => app.documents.edit(moveEntity("point", point.id, axis, value))}
      />
    </FieldRow>
  );
}
