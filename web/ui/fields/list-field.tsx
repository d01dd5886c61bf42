import { TextInput } from "@mantine/core";
import { useState, type KeyboardEvent } from "react";

export interface ListFieldProps {
  readonly label: string;
  readonly values: readonly number[];
  /** Returns why the numbers are invalid, or null if they are valid. */
  readonly refuse: (values: readonly number[]) => string | null;
  readonly onCommit: (values: readonly number[]) => void;
  readonly testId?: string;
}

const wholeNumbers = /-?\d+/g;

/** A list of integers, such as the points of a line: "1, 5, 6". Committed like a number field. */
export function ListField({ label, values, refuse, onCommit, testId }: ListFieldProps) {
  const [draft, setDraft] = useState<string | null>(null);
  const [error, setError] = useState<string | null>(null);
  const shown = values.join(", ");
  const commit = (): void => {
    if (draft === null) return;
    const next = (draft.replaceAll("−", "-").match(wholeNumbers) ?? []).map(Number);
    const reason = refuse(next);
    setError(reason);
    if (reason !== null) return;
    setDraft(null);
    if (next.join() !== values.join()) onCommit(next);
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.key === "Enter") commit();
    else if (event.key === "Escape" && draft !== null) {
      event.stopPropagation();
      setDraft(null);
      setError(null);
    }
  };
  return (
    <TextInput
      size="xs"
      aria-label={label}
      autoComplete="off"
      spellCheck={false}
      data-testid={testId}
      value={draft ?? shown}
      error={error}
      onChange={(event) => setDraft(event.currentTarget.value)}
      onBlur={commit}
      onKeyDown={onKeyDown}
    />
  );
}
