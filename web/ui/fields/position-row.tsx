import { FieldRow, type FieldRowProps } from "./field-row";
import { PositionFields, type PositionFieldsProps } from "./position-fields";

/** A row of a form with three coordinates. */
export function PositionRow({ hint = null, ...props }: PositionFieldsProps & Pick<FieldRowProps, "hint">) {
  return (
    <FieldRow label={props.label} hint={hint}>
      <PositionFields {...props} />
    </FieldRow>
  );
}
