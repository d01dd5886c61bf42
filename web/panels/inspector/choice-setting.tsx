import { SegmentedControl, Text } from "@mantine/core";
import type { ReactNode } from "react";
import { FieldRow } from "../../ui/fields/field-row";

export interface ChoiceSettingProps<Value extends string> {
  readonly label: string;
  readonly values: readonly Value[];
  readonly value: Value;
  /** Returns what the control shows for a value. */
  readonly labelOf: (value: Value) => ReactNode;
  /** What the current value means. */
  readonly hint: ReactNode;
  readonly onChange: (value: Value) => void;
}

/** A setting with a few values side by side, and the meaning of the current one below. */
export function ChoiceSetting<Value extends string>(props: ChoiceSettingProps<Value>) {
  const { label, values, value, labelOf, hint, onChange } = props;
  return (
    <>
      <FieldRow label={label}>
        <SegmentedControl<Value>
          size="xs"
          fullWidth
          aria-label={label}
          data={values.map((each) => ({ value: each, label: labelOf(each) }))}
          value={value}
          onChange={onChange}
        />
      </FieldRow>
      <SettingHint>{hint}</SettingHint>
    </>
  );
}

/** The text below a setting. */
export function SettingHint({ children }: { readonly children: ReactNode }) {
  return (
    <Text size="xs" c="dimmed" mb={6}>
      {children}
    </Text>
  );
}
