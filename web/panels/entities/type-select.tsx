import { Select, type SelectProps } from "@mantine/core";
import { strings } from "../../strings";

export interface TypeSelectProps<Type extends string> extends Pick<
  SelectProps,
  "comboboxProps" | "error" | "maxDropdownHeight"
> {
  readonly types: readonly { readonly value: Type; readonly label: string }[];
  /** Null if several entities have different types. */
  readonly value: Type | null;
  readonly renderOption?: (option: { readonly value: Type; readonly label: string }) => React.ReactNode;
  readonly onChange: (type: Type) => void;
  readonly testId: string;
}

/** Selects the type of an entity; there is always one. */
export function TypeSelect<Type extends string>({
  types,
  value,
  renderOption,
  onChange,
  testId,
  ...rest
}: TypeSelectProps<Type>) {
  const typeOf = (name: string | null) => types.find((type) => type.value === name);
  return (
    <Select
      size="xs"
      aria-label={strings.inspector.type}
      data-testid={testId}
      allowDeselect={false}
      data={types}
      value={value}
      placeholder={strings.fields.different}
      {...(renderOption && {
        renderOption: ({ option }) => renderOption({ value: option.value as Type, label: option.label }),
      })}
      onChange={(name) => {
        const chosen = typeOf(name);
        if (chosen) onChange(chosen.value);
      }}
      {...rest}
    />
  );
}
