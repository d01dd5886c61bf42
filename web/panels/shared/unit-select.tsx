import { Select } from "@mantine/core";
import { LENGTH_UNITS, type LengthUnit } from "tetrafront";
import { FieldRow } from "../../ui/fields/field-row";
import { strings } from "../../strings";

const none = "none";

interface UnitSelectProps {
  readonly label: string;
  readonly value: LengthUnit | null;
  /** Label of the choice without a unit; null if there is none. */
  readonly without: string | null;
  readonly testId: string;
  readonly onChange: (unit: LengthUnit | null) => void;
}

/** A choice of length units. */
export function UnitSelect({ label, value, without, testId, onChange }: UnitSelectProps) {
  const units = LENGTH_UNITS.map((unit) => ({ value: unit, label: strings.units[unit] }));
  return (
    <FieldRow label={label}>
      <Select
        size="xs"
        aria-label={label}
        data-testid={testId}
        data={[...(without === null ? [] : [{ value: none, label: without }]), ...units]}
        value={value ?? (without === null ? null : none)}
        placeholder={strings.units.other}
        allowDeselect={false}
        onChange={(chosen) => onChange(LENGTH_UNITS.find((unit) => unit === chosen) ?? null)}
      />
    </FieldRow>
  );
}
