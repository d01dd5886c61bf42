import { operationStrings } from "../../strings";
import type { FieldSpec, NumberSpec } from "./operation";

/** A length above 0. */
export const positiveLength = (key: string, label: string): FieldSpec => ({
  kind: "number",
  key,
  label,
  unit: "length",
  refuse: (value) => (value > 0 ? null : operationStrings.aboveZero),
});

/** A whole number within limits. */
export const wholeNumber = (key: string, label: string, min: number, max: number): NumberSpec => ({
  kind: "number",
  key,
  label,
  unit: null,
  whole: true,
  refuse: (value) =>
    Number.isInteger(value) && value >= min && value <= max ? null : operationStrings.wholeBetween(min, max),
});

/** An angle in degrees within limits. */
export const angleBetween = (key: string, label: string, min: number, max: number): FieldSpec => ({
  kind: "number",
  key,
  label,
  unit: "degrees",
  refuse: (value) => (value >= min && value <= max ? null : operationStrings.between(min, max)),
});
