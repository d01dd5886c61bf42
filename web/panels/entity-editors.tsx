import { Select } from "@mantine/core";
import type { Project, ProjectBackgroundNode, ProjectLine, ProjectPatch, ProjectPoint } from "tetrafront";
import {
  moveEntity,
  setLinePoints,
  setLineType,
  setNodeDirection,
  setNodeSize,
  setNodeStretching,
  setPatchLoops,
  setPatchType,
} from "../document/edits";
import { FieldRow } from "../ui/field-row";
import { ListField } from "../ui/list-field";
import { NumberField } from "../ui/number-field";
import { PlaceFields } from "../ui/place-fields";
import { lineTypeNames, patchTypeNames, strings } from "../ui/strings";
import { useApp } from "./app-context";

/** A round step for coordinates: about a fiftieth of the size wanted here, at least of the model's. */
function stepFor(project: Project): number {
  const sizes = project.background.nodes.map(({ size }) => size).filter((size) => size > 0);
  const smallest = sizes.length > 0 ? Math.min(...sizes) : 1;
  return 10 ** Math.round(Math.log10(smallest / 10));
}

export function PointEditor({ point, project }: { readonly point: ProjectPoint; readonly project: Project }) {
  const app = useApp();
  return (
    <FieldRow label={strings.inspector.position}>
      <PlaceFields
        key={point.id}
        label={strings.inspector.position}
        place={point.at}
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
/** Those that the engine meshes; a project may hold others, which then appear too. */
const patchTypes = optionsOf({ planar: patchTypeNames.planar, coons: patchTypeNames.coons });

export function LineEditor({ line, project }: { readonly line: ProjectLine; readonly project: Project }) {
  const app = useApp();
  const known = new Set(project.points.map(({ id }) => id));
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
      </FieldRow>
    </>
  );
}

export function PatchEditor({ patch, project }: { readonly patch: ProjectPatch; readonly project: Project }) {
  const app = useApp();
  const known = new Set(project.lines.map(({ id }) => id));
  const refuse = (steps: readonly number[]): string | null => {
    if (steps.length < 1) return strings.fields.oneLine;
    const unknown = steps.find((step) => !known.has(Math.abs(step)));
    return unknown === undefined ? null : strings.fields.unknownLine(String(Math.abs(unknown)));
  };
  const types = patchTypes.some(({ value }) => value === patch.type)
    ? patchTypes
    : [...patchTypes, { value: patch.type, label: patchTypeNames[patch.type] }];
  return (
    <>
      <FieldRow label={strings.inspector.type}>
        <Select
          size="xs"
          aria-label={strings.inspector.type}
          data-testid="patch-kind"
          allowDeselect={false}
          data={types}
          value={patch.type}
          onChange={(value) => {
            if (value !== null) app.documents.edit(setPatchType(patch.id, value as ProjectPatch["type"]));
          }}
        />
      </FieldRow>
      {patch.loops.map((loop, index) => {
        const label = index === 0 ? strings.inspector.outerLoop : strings.inspector.hole(index);
        return (
          <FieldRow key={`${patch.id}-${index}`} label={label}>
            <ListField
              label={`${label}. ${strings.inspector.loopHint}`}
              values={loop}
              refuse={refuse}
              testId={`patch-loop-${index}`}
              onCommit={(steps) =>
                app.documents.edit(setPatchLoops(patch.id, patch.loops.with(index, steps)))
              }
            />
          </FieldRow>
        );
      })}
    </>
  );
}

const aboveZero = (value: number): string | null => (value > 0 ? null : strings.fields.aboveZero);
const atLeastOne = (value: number): string | null => (value >= 1 ? null : strings.fields.atLeastOne);

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
          step={10 ** Math.floor(Math.log10(node.size / 5))}
          refuse={aboveZero}
          testId="bg-size"
          {...(project.units !== undefined && {
            rightSection: <span className="tf-unit">{project.units}</span>,
          })}
          onCommit={(value) => app.documents.edit(setNodeSize(node.id, value))}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.stretching}>
        <NumberField
          key={node.id}
          label={strings.inspector.stretching}
          value={stretching}
          step={0.1}
          refuse={atLeastOne}
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
          place={node.at}
          step={stepFor(project)}
          testId="at"
          onCommit={(axis, value) => app.documents.edit(moveEntity("background-node", node.id, axis, value))}
        />
      </FieldRow>
    </>
  );
}
