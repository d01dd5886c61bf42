import type { CurvatureSamples } from "tetrafront";
import type { DrawnSolid } from "tetrafront/internal";
import type { Project, ProjectBody, ProjectPreview, SolidFeature } from "tetrafront/project";
import type { Offer } from "../create";
import type { Entity } from "../entities";
import { quantity, type Quantity } from "../../expressions/quantity";
import type { Position } from "../position";
import { quantityPosition, type QuantityPosition } from "../quantity-positions";
import { zero } from "../vectors";

/**
 * Operations that add or change many entities by a few values, for example a box by its width, depth and height. A panel
 * shows a field per value, and the view shows what the values give until the user accepts it.
 */

export type FieldValue = number | string | boolean | Position;

/** The values of the fields, by key. */
export type FieldValues = Readonly<Record<string, FieldValue>>;

/** What numbers were typed as: by the key of the field, with `.0` to `.2` for a coordinate. Plain numbers have none. */
export type FieldExpressions = Readonly<Record<string, string>>;

/** The number of a field that was typed: `field` is its key in `FieldExpressions`. */
export interface TypedNumber {
  readonly field: string;
  /** Null for a plain number. */
  readonly expression: string | null;
}

/**
 * Returns the expressions of the fields after the value of one was changed: numbers that did not change keep theirs, and the
 * number that was typed gets its own.
 */
export function changedExpressions(
  expressions: FieldExpressions,
  key: string,
  [before, value]: readonly [FieldValue | undefined, FieldValue],
  typed?: TypedNumber,
): FieldExpressions {
  const kept = Object.entries(expressions).filter(([field]) => {
    const [name, axis] = field.split(".");
    const numberIn = (of: FieldValue | undefined): unknown =>
      axis !== undefined && typeof of === "object" ? of[Number(axis)] : of;
    return field !== typed?.field && (name !== key || numberIn(before) === numberIn(value));
  });
  const own = typed && typed.expression !== null ? [[typed.field, typed.expression] as const] : [];
  return Object.fromEntries([...kept, ...own]);
}

/** Returns a number of a field with the expression that it was typed as. */
export const typedNumber = (
  values: FieldValues,
  key: string,
  expressions: FieldExpressions = {},
): Quantity => {
  const value = values[key];
  return quantity(typeof value === "number" ? value : 0, expressions[key]);
};

/** Returns a position or direction of a field with the expressions that its coordinates were typed as. */
export const typedPosition = (
  values: FieldValues,
  key: string,
  expressions: FieldExpressions = {},
): QuantityPosition => {
  const value = values[key];
  const texts = [0, 1, 2].map((axis) => expressions[`${key}.${axis}`]);
  return quantityPosition(typeof value === "object" ? value : zero, texts);
};

interface FieldBase {
  readonly key: string;
  readonly label: string;
  /** Default: `operation-` and the key. */
  readonly testId?: string;
}

export interface NumberSpec extends FieldBase {
  readonly kind: "number";
  readonly unit: "length" | "degrees" | null;
  /** Whole numbers only. */
  readonly whole?: boolean;
  /** Fewer digits are filled with zeros in front: 0012. */
  readonly minDigits?: number;
  /** Returns why a number is invalid; null if it is valid. */
  readonly refuse?: (value: number) => string | null;
}

export interface PositionSpec extends FieldBase {
  readonly kind: "position";
}

/** A direction: an axis of coordinates, or any other. */
export interface DirectionSpec extends FieldBase {
  readonly kind: "direction";
}

export interface ChoiceSpec extends FieldBase {
  readonly kind: "choice";
  readonly choices: readonly { readonly value: string; readonly label: string }[];
}

export interface SwitchSpec extends FieldBase {
  readonly kind: "switch";
}

export type FieldSpec = NumberSpec | PositionSpec | DirectionSpec | ChoiceSpec | SwitchSpec;

/** A place in the view that the user can drag, instead of typing a value. */
export interface OperationHandle {
  /** The field that it changes: a number, or a position. */
  readonly key: string;
  readonly position: Position;
  /** A line leads from here to the handle. */
  readonly from: Position;
  /** Unit vector along which it moves; null for a position. */
  readonly along: Position | null;
  /** Change of the number for a unit of length along the direction. */
  readonly rate: number;
  /** Returns the value of a position in the view. Default: the position itself. */
  readonly valueAt?: (position: Position) => Position;
}

/** What the values of an operation apply to. */
export interface Subject {
  readonly project: Project;
  /** In the order of selection. */
  readonly selection: readonly Entity[];
}

/** Positions on what is drawn, in the order of the project. */
export interface DrawnSamples {
  readonly lines: Pick<ProjectPreview, "linePoints" | "lineOffsets">;
  readonly patches: Pick<CurvatureSamples, "points" | "triangles" | "patchOffsets">;
}

/** Makes solids of features, which takes a moment. */
export interface SolidMaker {
  /**
   * Returns the body of features, with those that fail: a given one, changed, or a new one. Rejects with a sentence if nothing is
   * left.
   */
  bodyOf(
    project: Project,
    before: ProjectBody | { readonly name: string },
    features: readonly SolidFeature[],
  ): Promise<ProjectBody>;
  /** Returns the edges of the solid, each with the origins of the faces beside it. */
  edgesOf(
    features: readonly SolidFeature[],
  ): Promise<readonly { readonly name: string; readonly faces: readonly [string, string] }[]>;
  /** Returns the solid as lines and patches. */
  drawn(features: readonly SolidFeature[]): Promise<DrawnSolid>;
  /** Returns positions on the lines and patches of a project, with as many rows and columns per curved patch. */
  samplesOf(project: Project, cells: number): Promise<DrawnSamples>;
}

/** An operation with its fields. `Values` is a type of the same keys as the fields. */
export interface Operation<Values extends FieldValues = FieldValues> {
  readonly id: string;
  readonly title: string;
  /** Name of the step of undo. */
  readonly step: string;
  /** Label of the button that accepts the result. */
  readonly action: string;
  /** Whether the operation applies to selected entities. It then follows the selection while its panel is open. */
  readonly usesSelection: boolean;
  /** The values at first. */
  initial(subject: Subject): Values;
  /** What the numbers of the values at first were typed as. */
  expressions?(): FieldExpressions;
  /** The fields to show, which may depend on the values. */
  fields(values: Values, subject: Subject): readonly FieldSpec[];
  /** The handles in the view. */
  handles?(values: Values): readonly OperationHandle[];
  /** What the user should know about the result before accepting it. */
  note?(values: Values, subject: Subject, expressions?: FieldExpressions): string;
  /** What the values give. The project keeps the expressions, if the numbers that they give can be computed from them. */
  make(subject: Subject, values: Values, expressions?: FieldExpressions): Offer;
  /** What the values give, if the kernel must compute it: null for values that `make` serves. */
  makeLater?(
    subject: Subject,
    values: Values,
    solids: SolidMaker,
    expressions?: FieldExpressions,
  ): Promise<Offer> | null;
}
