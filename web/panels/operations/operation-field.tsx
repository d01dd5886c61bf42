import { Box, SegmentedControl, Switch, Text } from "@mantine/core";
import { useState, type ReactNode } from "react";
import type { FieldSpec, FieldValue, NumberSpec, TypedNumber } from "../../document/operations/operation";
import type { Position } from "../../document/position";
import type { OpenOperation } from "../../session/operations";
import { namesIn } from "../../expressions/expression";
import { operationStrings } from "../../strings";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberRow } from "../../ui/fields/number-row";
import { PositionFields } from "../../ui/fields/position-fields";
import { PositionRow } from "../../ui/fields/position-row";
import { Unit } from "../../ui/fields/unit";
import { useApp } from "../shared/app-context";
import { sizeStep, unitsOf } from "../shared/size-fields";
import { pieceExtent } from "../../document/operations/sizes";

interface OperationFieldProps {
  readonly spec: FieldSpec;
  readonly open: OpenOperation;
}

/** The field of one value of an operation. */
export function OperationField({ spec, open }: OperationFieldProps) {
  const app = useApp();
  const { key, label } = spec;
  const value = open.values[key];
  const set = (next: FieldValue, typed?: TypedNumber): void => app.operations.set(key, next, typed);
  const setCoordinate = (before: Position, axis: 0 | 1 | 2, x: number, expression: string | null): void =>
    set(withCoordinate(before, axis, x), { field: `${key}.${axis}`, expression });
  const expressions = [0, 1, 2].map((axis) => open.expressions[`${key}.${axis}`]);
  const testId = spec.testId ?? `operation-${key}`;
  switch (spec.kind) {
    case "number":
      return typeof value === "number" && <NumberValue spec={spec} value={value} open={open} onSet={set} />;
    case "position":
      return (
        isPosition(value) && (
          <PositionRow
            label={label}
            value={value}
            step={coordinateStep(open)}
            live
            testId={testId}
            expressions={expressions}
            onCommit={(...typed) => setCoordinate(value, ...typed)}
          />
        )
      );
    case "direction":
      return (
        isPosition(value) && (
          <DirectionField
            label={label}
            value={value}
            expressions={expressions}
            testId={testId}
            onSet={set}
            onCommit={(...typed) => setCoordinate(value, ...typed)}
          />
        )
      );
    case "choice":
      return (
        typeof value === "string" && (
          <ChoiceRow label={label} isWide={spec.choices.length > 2}>
            <SegmentedControl
              size="xs"
              fullWidth
              aria-label={label}
              data={[...spec.choices]}
              value={value}
              data-testid={testId}
              onChange={set}
            />
          </ChoiceRow>
        )
      );
    case "switch":
      return (
        <Switch
          size="xs"
          my={8}
          label={label}
          checked={value === true}
          data-testid={testId}
          onChange={(event) => set(event.currentTarget.checked)}
        />
      );
  }
}

interface ChoiceRowProps {
  readonly label: string;
  /** Whether the choices need the width of the panel. The label is then that of the control. */
  readonly isWide: boolean;
  readonly children: ReactNode;
}

function ChoiceRow({ label, isWide, children }: ChoiceRowProps) {
  return isWide ? <Box mb={6}>{children}</Box> : <FieldRow label={label}>{children}</FieldRow>;
}

interface NumberValueProps {
  readonly spec: NumberSpec;
  readonly value: number;
  readonly open: OpenOperation;
  readonly onSet: (value: number, typed: TypedNumber) => void;
}

function NumberValue({ spec, value, open, onSet }: NumberValueProps) {
  const { key, label, unit, whole, minDigits, refuse } = spec;
  const { project } = open.subject;
  // Whole numbers keep no expression. True if one with parameters was typed: a note then shows the number.
  const [wasExpression, setWasExpression] = useState(false);
  const step = whole === true ? 1 : unit === "degrees" ? 5 : lengthStep(value, open);
  return (
    <>
      <NumberRow
        label={label}
        value={value}
        step={step}
        live
        testId={`operation-${key}`}
        {...(minDigits !== undefined && { minDigits })}
        {...(refuse && { refuse })}
        {...(unit === "length" && unitsOf(project))}
        {...(unit === "degrees" && { rightSection: <Unit>°</Unit> })}
        expression={open.expressions[key]}
        onCommit={(next, expression) => {
          setWasExpression(whole === true && namesIn(expression ?? "").size > 0);
          onSet(next, { field: key, expression: whole === true ? null : expression });
        }}
      />
      {wasExpression && (
        <Text size="xs" c="dimmed" role="status" data-testid={`operation-${key}-note`}>
          {operationStrings.wholeNumber(value)}
        </Text>
      )}
    </>
  );
}

const axes: readonly (readonly [name: "x" | "y" | "z", direction: Position])[] = [
  ["x", [1, 0, 0]],
  ["y", [0, 1, 0]],
  ["z", [0, 0, 1]],
];

interface DirectionFieldProps {
  readonly label: string;
  readonly value: Position;
  readonly expressions: readonly (string | undefined)[];
  readonly testId: string;
  readonly onSet: (direction: Position) => void;
  readonly onCommit: (axis: 0 | 1 | 2, value: number, expression: string | null) => void;
}

/** A choice between the axes of coordinates and a direction of three numbers. */
function DirectionField({ label, value, expressions, testId, onSet, onCommit }: DirectionFieldProps) {
  const axis = axes.find(([, direction]) => direction.every((x, k) => x === value[k]));
  const [isOther, setOther] = useState(axis === undefined);
  const names = operationStrings.directions;
  return (
    <FieldRow label={label}>
      <SegmentedControl
        size="xs"
        fullWidth
        aria-label={label}
        data={[
          ...axes.map(([name]) => ({ value: name, label: names[name] })),
          { value: "other", label: names.other },
        ]}
        value={isOther ? "other" : (axis?.[0] ?? "other")}
        data-testid={testId}
        onChange={(chosen) => {
          const direction = axes.find(([name]) => name === chosen)?.[1];
          setOther(!direction);
          if (direction) onSet(direction);
        }}
      />
      {isOther && (
        <PositionFields
          label={label}
          value={value}
          step={0.1}
          live
          testId={testId}
          expressions={expressions}
          onCommit={onCommit}
        />
      )}
    </FieldRow>
  );
}

const isPosition = (value: unknown): value is Position => Array.isArray(value);

const coordinateStep = ({ subject }: OpenOperation): number => sizeStep(pieceExtent(subject.project));

/** A step for a length: relative to itself, or to the model if it is 0 or may be negative. */
const lengthStep = (value: number, open: OpenOperation): number =>
  value > 0 ? sizeStep(value) : coordinateStep(open);

function withCoordinate([x, y, z]: Position, axis: 0 | 1 | 2, value: number): Position {
  return [axis === 0 ? value : x, axis === 1 ? value : y, axis === 2 ? value : z];
}
