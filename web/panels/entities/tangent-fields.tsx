import { Button } from "@mantine/core";
import { IconTrash } from "@tabler/icons-react";
import type { Project, ProjectLine } from "tetrafront/project";
import { setTangent } from "../../document/edits";
import { findRecord } from "../../document/entities";
import { subtract } from "../../document/vectors";
import { FieldRow } from "../../ui/fields/field-row";
import { PositionFields } from "../../ui/fields/position-fields";
import { IconButton } from "../../ui/icon-button";
import { strings } from "../../strings";
import { useApp } from "../shared/app-context";

interface TangentFieldsProps {
  readonly line: ProjectLine;
  readonly project: Project;
}

/** The tangents at the ends of a spline or Hermite line. A new one has the direction of the first or last chord. */
export function TangentFields({ line, project }: TangentFieldsProps) {
  return (["startTangent", "endTangent"] as const).map((end) => (
    <TangentField key={end} line={line} project={project} end={end} />
  ));
}

interface TangentFieldProps extends TangentFieldsProps {
  readonly end: "startTangent" | "endTangent";
}

function TangentField({ line, project, end }: TangentFieldProps) {
  const { documents } = useApp();
  const { id, points } = line;
  const tangent = line[end];
  const testId = end === "startTangent" ? "start-tangent" : "end-tangent";
  const give = (): void => {
    const chord = end === "startTangent" ? points.slice(0, 2) : points.slice(-2);
    const [from, to] = chord.map((point) => findRecord(project, "point", point)?.position);
    if (from && to) documents.edit(setTangent(id, end, subtract(to, from)));
  };
  return (
    <FieldRow label={strings.inspector[end]}>
      {tangent ? (
        <>
          <PositionFields
            label={strings.inspector[end]}
            value={tangent}
            step={0.1}
            testId={testId}
            refuse={(axis, value) =>
              tangent.with(axis, value).every((x) => x === 0) ? strings.fields.zeroDirection : null
            }
            onCommit={(axis, value) => {
              const [x, y, z] = tangent.with(axis, value);
              documents.edit(setTangent(id, end, [x ?? 0, y ?? 0, z ?? 0]));
            }}
          />
          <IconButton
            label={strings.inspector.removeTangent}
            size={28}
            onClick={() => documents.edit(setTangent(id, end, null))}
          >
            <IconTrash size={15} aria-hidden />
          </IconButton>
        </>
      ) : (
        <Button size="compact-xs" variant="default" data-testid={`give-${testId}`} onClick={give}>
          {strings.inspector.giveTangent}
        </Button>
      )}
    </FieldRow>
  );
}
