import { LIMITS } from "tetrafront";
import {
  type LineType,
  type PatchType,
  BODY_SURFACES,
  type BodySurface,
  type Project,
  type ProjectBackgroundNode,
} from "tetrafront/project";
import { Fragment } from "react";
import { SegmentedControl } from "@mantine/core";
import { setCommonSurface } from "../../document/body-edits";
import {
  commonNumbers,
  commonSurface,
  commonType,
  ownNames,
  setCommonLineType,
  setCommonNumber,
  setCommonPatchType,
  type CommonField,
  type CommonNumber,
} from "../../document/common-edits";
import type { Entity } from "../../document/entities";
import { lineTypes } from "../../document/line-types";
import { patchTypes } from "../../document/patch-rules";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberRow } from "../../ui/fields/number-row";
import { PositionRow } from "../../ui/fields/position-row";
import { lineTypeNames, patchTypeNames, strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { aboveZero, atLeastOne, notNegative, sizeStep, stepFor, unitsOf, upTo } from "../shared/size-fields";
import { DirectionRow } from "./direction-row";
import styles from "./selection-card.module.css";
import { useOwnNumbers } from "./use-own-numbers";
import { TypeSelect } from "./type-select";

interface CommonFieldsProps {
  readonly entities: readonly Entity[];
  readonly project: Project;
}

/** Fields of everything that several entities have in common; each changes all of them. */
export function CommonFields({ entities, project }: CommonFieldsProps) {
  const surface = commonSurface(project, entities);
  // Other treatments do not remesh.
  const isShown = ({ field }: CommonNumber): boolean =>
    surface === "remesh" || !field.startsWith("remeshing.");
  const all = commonNumbers(project, entities);
  const nodes = stretchedNodes(project, entities, all);
  const numbers = all.filter(
    (number) => isShown(number) && (nodes !== null || number.field !== "secondStretching"),
  );
  const parameters = new Set(project.parameters?.map(({ name }) => name));
  const named = numbers
    .filter(({ smallest }) => smallest !== null)
    .map(({ field }) => ownNames[field])
    .filter((name) => !parameters.has(name));
  const isPositioned = numbers.some(({ field }) => field === "position.0");
  return (
    <section className={styles["fields"]} data-testid="common-fields">
      {isPositioned && <CommonPosition entities={entities} project={project} numbers={numbers} />}
      {numbers.map((number) => (
        <Fragment key={number.field}>
          <CommonNumberRow entities={entities} project={project} number={number} />
          {nodes && number.field === "stretching" && (
            <DirectionRow nodes={nodes} field="direction" project={project} testId="common-direction" />
          )}
          {nodes && number.field === "secondStretching" && number.value !== 1 && (
            <DirectionRow
              nodes={nodes}
              field="secondDirection"
              project={project}
              testId="common-second-direction"
            />
          )}
        </Fragment>
      ))}
      {named.length > 0 && <p className={styles["hint"]}>{strings.fields.ownValues(named)}</p>}
      {surface !== undefined && <CommonTreatment entities={entities} surface={surface} />}
      <CommonTypes entities={entities} project={project} />
    </section>
  );
}

/** Returns the background nodes that are selected; null if none of them is stretched, or other entities are selected. */
function stretchedNodes(
  { background }: Project,
  entities: readonly Entity[],
  numbers: readonly CommonNumber[],
): readonly ProjectBackgroundNode[] | null {
  const isStretched = numbers.some(({ field, value }) => /stretching$/i.test(field) && value !== 1);
  if (!isStretched) return null;
  const ids = new Set(entities.map(({ id }) => id));
  return background.nodes.filter(({ id }) => ids.has(id));
}

function CommonPosition({
  entities,
  project,
  numbers,
}: CommonFieldsProps & { readonly numbers: readonly CommonNumber[] }) {
  const { documents } = useApp();
  const own = useOwnNumbers(project, entities);
  const at = (axis: 0 | 1 | 2) => numbers.find(({ field }) => field === `position.${axis}`);
  return (
    <PositionRow
      label={strings.inspector.position}
      value={[at(0)?.value ?? null, at(1)?.value ?? null, at(2)?.value ?? null]}
      expressions={([0, 1, 2] as const).map((axis) => at(axis)?.expression)}
      own={(axis) => own(`position.${axis}`)}
      step={stepFor(project)}
      testId="common-position"
      onCommit={(axis, value, expression) =>
        documents.edit(setCommonNumber(entities, `position.${axis}`, value, expression))
      }
    />
  );
}

function CommonTreatment({
  entities,
  surface,
}: {
  readonly entities: readonly Entity[];
  readonly surface: BodySurface | null;
}) {
  const { documents } = useApp();
  const { label, values } = strings.bodies.treatment;
  return (
    <FieldRow label={label}>
      <SegmentedControl
        size="xs"
        fullWidth
        aria-label={label}
        data-testid="common-treatment"
        data={BODY_SURFACES.map((value) => ({ value, label: values[value] }))}
        value={surface ?? ""}
        onChange={(value) => {
          const chosen = BODY_SURFACES.find((one) => one === value);
          const ids = entities.map(({ id }) => id);
          if (chosen) documents.edit(setCommonSurface(ids, chosen));
        }}
      />
    </FieldRow>
  );
}

/** Labels of the numbers, except positions. */
const labels = {
  size: strings.inspector.size,
  stretching: strings.inspector.stretching,
  secondStretching: strings.inspector.secondStretching,
  distance: strings.inspector.distance,
  growth: strings.inspector.growth,
  "placement.scale": strings.bodies.placement.scale,
  "remeshing.size": strings.bodies.treatment.fields.size,
  "remeshing.tolerance": strings.bodies.treatment.fields.tolerance,
} as const;

/** Numbers without a unit. */
const factors: ReadonlySet<CommonField> = new Set([
  "stretching",
  "secondStretching",
  "growth",
  "placement.scale",
]);

const refusals: Readonly<Partial<Record<CommonField, (value: number) => string | null>>> = {
  size: upTo(LIMITS.length, aboveZero),
  stretching: upTo(LIMITS.stretching, atLeastOne),
  secondStretching: upTo(LIMITS.stretching, atLeastOne),
  distance: upTo(LIMITS.length, notNegative),
  growth: upTo(LIMITS.growth, notNegative),
  "placement.scale": upTo(LIMITS.length, aboveZero),
  "remeshing.size": upTo(LIMITS.length, aboveZero),
  "remeshing.tolerance": upTo(LIMITS.length, aboveZero),
};

function CommonNumberRow({
  entities,
  project,
  number: { field, value, isAutomatic, smallest, expression },
}: CommonFieldsProps & { readonly number: CommonNumber }) {
  const { documents } = useApp();
  const own = useOwnNumbers(project, entities);
  if (field === "position.0" || field === "position.1" || field === "position.2") return null;
  const refuse = refusals[field];
  const isLength = !factors.has(field);
  return (
    <NumberRow
      label={labels[field]}
      value={value}
      {...(isAutomatic && { placeholder: strings.bodies.treatment.automatic })}
      expression={expression}
      own={own(field)}
      step={isLength ? sizeStep(smallest ?? 1) : 0.05}
      testId={`common-${field.replace(".", "-")}`}
      {...(refuse && { refuse })}
      {...(isLength && unitsOf(project))}
      onCommit={(next, text) => documents.edit(setCommonNumber(entities, field, next, text))}
    />
  );
}

const lineOptions = lineTypes.map((value) => ({ value, label: lineTypeNames[value] }));
const patchOptions = patchTypes.map((value) => ({ value, label: patchTypeNames[value] }));

function CommonTypes({ entities, project }: CommonFieldsProps) {
  const { documents } = useApp();
  const line = commonType(project, entities, "line");
  const patch = commonType(project, entities, "patch");
  if (line === undefined && patch === undefined) return null;
  return (
    <FieldRow label={strings.inspector.type}>
      {line !== undefined && (
        <TypeSelect<LineType>
          types={lineOptions}
          value={line as LineType | null}
          testId="common-type"
          onChange={(type) => documents.edit(setCommonLineType(entities, type))}
        />
      )}
      {patch !== undefined && (
        <TypeSelect<PatchType>
          types={patchOptions}
          value={patch as PatchType | null}
          testId="common-type"
          onChange={(type) => documents.edit(setCommonPatchType(entities, type))}
        />
      )}
    </FieldRow>
  );
}
