import { Switch } from "@mantine/core";
import type { Project, ProjectLine } from "tetrafront/project";
import { setLinePoints, setLineType } from "../../document/edits";
import { isClosed } from "../../document/line-courses";
import { lineTypes, runsThroughMany } from "../../document/line-types";
import { FieldRow } from "../../ui/fields/field-row";
import { ListField } from "../../ui/fields/list-field";
import { lineTypeNames, strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { refuseIds } from "./refuse-ids";
import { TangentFields } from "./tangent-fields";
import { TypeSelect } from "./type-select";

const types = lineTypes.map((value) => ({ value, label: lineTypeNames[value] }));

/** The type and the points of a line. */
export function LineEditor({ line, project }: { readonly line: ProjectLine; readonly project: Project }) {
  const { documents } = useApp();
  const { id, type, points } = line;
  const rule = {
    known: new Set(project.points.map((point) => point.id)),
    atLeast: 2,
    tooFew: strings.fields.twoPoints,
    unknown: strings.fields.unknownPoint,
  };
  const setPoints = (changed: readonly number[]): void => documents.edit(setLinePoints(id, changed));
  return (
    <>
      <FieldRow label={strings.inspector.type}>
        <TypeSelect
          types={types}
          value={type}
          testId="line-type"
          onChange={(value) => documents.edit(setLineType(id, value))}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.points}>
        <ListField
          label={strings.inspector.linePointsHint}
          values={points}
          refuse={(ids) => refuseIds(ids, rule)}
          testId="line-points"
          onCommit={setPoints}
        />
        {runsThroughMany(type) && <ClosedSwitch points={points} onChange={setPoints} />}
      </FieldRow>
      {runsThroughMany(type) && !isClosed(line) && <TangentFields line={line} project={project} />}
    </>
  );
}

interface ClosedSwitchProps {
  readonly points: readonly number[];
  readonly onChange: (points: readonly number[]) => void;
}

/** A spline is closed if its last point is the first one again. */
function ClosedSwitch({ points, onChange }: ClosedSwitchProps) {
  const closed = points[0] === points.at(-1);
  return (
    <Switch
      size="xs"
      mt={6}
      label={strings.inspector.closed}
      data-testid="line-closed"
      checked={closed}
      onChange={() => onChange(closed ? points.slice(0, -1) : [...points, ...points.slice(0, 1)])}
    />
  );
}
