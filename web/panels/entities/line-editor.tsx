import { Select, Switch } from "@mantine/core";
import type { Project, ProjectLine } from "tetrafront";
import { setLinePoints, setLineType } from "../../document/edits";
import { FieldRow } from "../../ui/fields/field-row";
import { ListField } from "../../ui/fields/list-field";
import { lineTypeNames, strings } from "../../strings";
import { useApp } from "../shared/app-context";

const lineTypes = Object.entries(lineTypeNames).map(([value, label]) => ({ value, label }));

/** The type and the points of a line. */
export function LineEditor({ line, project }: { readonly line: ProjectLine; readonly project: Project }) {
  const app = useApp();
  const known = new Set(project.points.map(({ id }) => id));
  const closed = line.points[0] === line.points.at(-1);
  const refuse = (points: readonly number[]): string | null => {
    if (points.length < 2) return strings.fields.twoPoints;
    const unknown = points.find((id) => !known.has(id));
    return unknown === undefined ? null : strings.fields.unknownPoint(String(unknown));
  };
  return (
    <>
      <FieldRow label={strings.inspector.type}>
        <Select
          size="xs"
          aria-label={strings.inspector.type}
          data-testid="line-type"
          allowDeselect={false}
          data={lineTypes}
          value={line.type}
          onChange={(value) => {
            if (value !== null) app.documents.edit(setLineType(line.id, value as ProjectLine["type"]));
          }}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.points}>
        <ListField
          key={line.id}
          label={strings.inspector.linePointsHint}
          values={line.points}
          refuse={refuse}
          testId="line-points"
          onCommit={(points) => app.documents.edit(setLinePoints(line.id, points))}
        />
        {line.type === "spline" && (
          <Switch
            size="xs"
            mt={6}
            label={strings.inspector.closed}
            data-testid="line-closed"
            checked={closed}
            onChange={() => {
              const points = closed ? line.points.slice(0, -1) : [...line.points, ...line.points.slice(0, 1)];
              app.documents.edit(setLinePoints(line.id, points));
            }}
          />
        )}
      </FieldRow>
    </>
  );
}
