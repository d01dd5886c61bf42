import { FieldRow } from "./field-row";
import { PositionFields, type PositionFieldsProps } from "./position-fields";

/** A row of a form with three coordinates. */
export function PositionRow(props: PositionFieldsProps) {
  return (
    <FieldRow label={props.label}>
      <PositionFields {...props} />
    </FieldRow>
  );
}
