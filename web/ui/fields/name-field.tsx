import { TextInput } from "@mantine/core";
import { useState, type KeyboardEvent } from "react";

/** Letters of a name at most: programs that read meshes permit 80 to 255. */
const maxLetters = 120;

export interface NameFieldProps {
  readonly label: string;
  readonly value: string;
  readonly placeholder: string;
  readonly onCommit: (value: string) => void;
  /** Returns why a text is invalid, or null if it is valid. An invalid text stays, with the reason. */
  readonly refuse?: (value: string) => string | null;
  readonly testId?: string;
}

/** A name. Enter and leaving the field commit it; Escape discards the text. */
export function NameField(props: NameFieldProps) {
  const { label, value, placeholder, onCommit, refuse, testId } = props;
  const [draft, setDraft] = useState<string | null>(null);
  const [error, setError] = useState<string | null>(null);
  const commit = (): void => {
    const next = draft?.trim();
    const reason = next === undefined || next === value ? null : (refuse?.(next) ?? null);
    setError(reason);
    if (reason !== null) return;
    setDraft(null);
    if (next !== undefined && next !== value) onCommit(next);
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
      maxLength={Math.max(maxLetters, value.length)}
      title={value}
      placeholder={placeholder}
      data-testid={testId}
      value={draft ?? value}
      error={error}
      onChange={(event) => setDraft(event.currentTarget.value)}
      onBlur={commit}
      onKeyDown={onKeyDown}
    />
  );
}
