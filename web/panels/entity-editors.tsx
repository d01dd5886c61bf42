import { Select, Switch, Text } from "@mantine/core";
import {
  LIMITS,
  type Project,
  type ProjectBackgroundNode,
  type ProjectLine,
  type ProjectPoint,
  type ProjectSource,
} from "tetrafront";
import {
  moveEntity,
  moveSource,
  setLinePoints,
  setLineType,
  setNodeDirection,
  setNodeSize,
  setNodeStretching,
  setSourceField,
} from "../document/edits";
import { FieldRow } from "../ui/field-row";
import { ListField } from "../ui/list-field";
import { NumberField } from "../ui/number-field";
import { PlaceFields } from "../ui/place-fields";
import { aboveZero, atLeastOne, notNegative, sizeStep, stepFor, unitsOf, upTo } from "./size-fields";
import { lineTypeNames, strings } from "../ui/strings";
import { useApp } from "./app-context";

export function PointEditor({ point, project }: { readonly point: ProjectPoint; readonly project: Project }) {
  const app = useApp();
  return (
    <FieldRow label={strings.inspector.position}>
      <PlaceFields
        key={point.id}
        label={strings.inspector.position}
        place={point.position}
        step={stepFor(project)}
        testId="at"
        onCommit={(axis, value) => app.documents.edit(moveEntity("point", point.id, axis, value))}
      />
    </FieldRow>
  );
}

const optionsOf = (names: Readonly<Record<string, string>>) =>
  Object.entries(names).map(([value, label]) => ({ value, label }));

const lineTypes = optionsOf(lineTypeNames);

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

interface NodeEditorProps {
  readonly node: ProjectBackgroundNode;
  readonly project: Project;
}

export function NodeEditor({ node, project }: NodeEditorProps) {
  const app = useApp();
  const direction = node.direction ?? [1, 0, 0];
  const stretching = node.stretching ?? 1;
  const refuseZero = (axis: 0 | 1 | 2, value: number): string | null =>
    direction.with(axis, value).every((x) => x === 0) ? strings.fields.zeroDirection : null;
  return (
    <>
      <FieldRow label={strings.inspector.size}>
        <NumberField
          key={node.id}
          label={strings.inspector.size}
          value={node.size}
          step={sizeStep(node.size)}
          refuse={upTo(LIMITS.length, aboveZero)}
          testId="bg-size"
          {...unitsOf(project)}
          onCommit={(value) => app.documents.edit(setNodeSize(node.id, value))}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.stretching}>
        <NumberField
          key={node.id}
          label={strings.inspector.stretching}
          value={stretching}
          step={0.1}
          refuse={upTo(LIMITS.stretching, atLeastOne)}
          testId="bg-stretch"
          rightSection={<span className="tf-unit">×</span>}
          onCommit={(value) => app.documents.edit(setNodeStretching(node.id, value))}
        />
      </FieldRow>
      {stretching !== 1 && (
        <FieldRow label={strings.inspector.direction}>
          <PlaceFields
            key={node.id}
            label={strings.inspector.direction}
            place={direction}
            step={0.1}
            refuse={refuseZero}
            testId="direction"
            onCommit={(axis, value) => app.documents.edit(setNodeDirection(node.id, axis, value))}
          />
        </FieldRow>
      )}
      <FieldRow label={strings.inspector.position}>
        <PlaceFields
          key={node.id}
          label={strings.inspector.position}
          place={node.position}
          step={stepFor(project)}
          testId="at"
          onCommit={(axis, value) => app.documents.edit(moveEntity("background-node", node.id, axis, value))}
        />
      </FieldRow>
    </>
  );
}

/** Growth of a source that does not say. */
const defaultGrowth = 0.3;

interface SourceEditorProps {
  readonly source: ProjectSource;
  readonly project: Project;
}

export function SourceEditor({ source, project }: SourceEditorProps) {
  const app = useApp();
  const { id, size, distance = 0, growth = defaultGrowth, positions: places } = source;
  const set = (field: "size" | "distance" | "growth") => (value: number) =>
    app.documents.edit(setSourceField(id, field, value));
  return (
    <>
      <FieldRow label={strings.inspector.size}>
        <NumberField
          key={id}
          label={strings.inspector.size}
          value={size}
          step={sizeStep(size)}
          refuse={upTo(LIMITS.length, aboveZero)}
          testId="source-size"
          {...unitsOf(project)}
          onCommit={set("size")}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.distance}>
        <NumberField
          key={id}
          label={strings.inspector.distance}
          value={distance}
          step={sizeStep(size)}
          refuse={upTo(LIMITS.length, notNegative)}
          testId="source-distance"
          {...unitsOf(project)}
          onCommit={set("distance")}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.growth}>
        <NumberField
          key={id}
          label={strings.inspector.growth}
          value={growth}
          step={0.05}
          refuse={upTo(LIMITS.growth, notNegative)}
          testId="source-growth"
          onCommit={set("growth")}
        />
      </FieldRow>
      {places.map((place, index) => (
        <FieldRow key={`${id}-${index}`} label={strings.inspector.place(index, places.length)}>
          <PlaceFields
            label={strings.inspector.place(index, places.length)}
            place={place}
            step={stepFor(project)}
            testId={`place-${index}`}
            onCommit={(axis, value) => app.documents.edit(moveSource(id, index, axis, value))}
          />
        </FieldRow>
      ))}
      <Text size="sm" c="dimmed">
        {strings.inspector.sourceRule}
      </Text>
    </>
  );
}
