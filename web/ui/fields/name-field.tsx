import { TextInput } from "@mantine/core";
import { useEffect, useRef, useState, type KeyboardEvent } from "react";

export interface NameFieldProps {
  readonly label: string;
  readonly value: string;
  readonly placeholder: string;
  readonly onCommit: (value: string) => void;
  readonly testId?: string;
  /** Each new number moves the focus to the field and selects its text. */
  readonly focusRequest?: number;
}

/** A name. Enter and leaving the field commit it; Escape discards the text. */
export function NameField({ label, value, placeholder, onCommit, testId, focusRequest = 0 }: NameFieldProps) {
  const [draft, setDraft] = useState<string | null>(null);
  const field = useRef<HTMLInputElement>(null);
  const answered = useRef(focusRequest);
  useEffect(() => {
    if (focusRequest === answered.current) return;
    answered.current = focusRequest;
    field.current?.select();
  }, [focusRequest]);
  const commit = (): void => {
    const next = draft?.trim();
    setDraft(null);
    if (next !== undefined && next !== value) onCommit(next);
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.key === "Enter") commit();
    else if (event.key === "Escape" && draft !== null) {
      event.stopPropagation();
      setDraft(null);
    }
  };
  return (
    <TextInput
      ref={field}
      size="xs"
      aria-label={label}
      autoComplete="off"
      placeholder={placeholder}
      data-testid={testId}
      value={draft ?? value}
      onChange={(event) => setDraft(event.currentTarget.value)}
      onBlur={commit}
      onKeyDown={onKeyDown}
    />
  );
}
