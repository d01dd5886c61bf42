import { FieldRow } from "./field-row";
import { NumberField, type NumberFieldProps } from "./number-field";

/** A row of a form with one number. */
export function NumberRow(props: NumberFieldProps) {
  return (
    <FieldRow label={props.label}>
      <NumberField {...props} />
    </FieldRow>
  );
}
