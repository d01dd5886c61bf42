import { TextInput } from "@mantine/core";
import { useRef, useState, type KeyboardEvent, type ReactNode } from "react";
import { useFormField } from "../frames/dialog-form";
import { readNumber } from "./expression";
import { formatNumber } from "../format";
import { strings } from "../../strings";

export interface NumberFieldProps {
  /** Label for screen readers; the row around the field shows a label of its own. */
  readonly label: string;
  readonly value: number;
  /** Change per press of an arrow key. Shift multiplies it by 10, Alt by 0.1. */
  readonly step: number;
  /** Returns why a number is invalid, or null if it is valid. */
  readonly refuse?: (value: number) => string | null;
  readonly onCommit: (value: number) => void;
  /** Text before and after the number, for example the axis and the unit. */
  readonly leftSection?: ReactNode;
  readonly rightSection?: ReactNode;
  readonly leftSectionWidth?: number;
  readonly testId?: string;
  /** Also commit valid numbers while they are typed. */
  readonly live?: boolean;
  /** This field of a dialog gets the focus first. */
  readonly first?: boolean;
}

/** Direction of each arrow key. */
const directions: Readonly<Record<string, 1 | -1>> = { ArrowUp: 1, ArrowDown: -1 };

function stepOf(event: KeyboardEvent, step: number): number {
  return step * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
}

/** The text that is being typed into a number field; null if the field shows its value. */
function useNumberDraft({ value, refuse, live = false, onCommit }: NumberFieldProps) {
  const [draft, setDraft] = useState<string | null>(null);
  const [error, setError] = useState<string | null>(null);
  const discard = (): void => {
    setDraft(null);
    setError(null);
  };
  /** Commits a number, unless it is invalid: then returns false and keeps the text, with the reason. */
  const take = (next: number | null): boolean => {
    const reason = next === null ? strings.fields.notANumber : (refuse?.(next) ?? null);
    setError(reason);
    if (next === null || reason !== null) return false;
    setDraft(null);
    if (next !== value) onCommit(next);
    return true;
  };
  const commit = (): boolean => {
    if (draft === null) return true;
    if (draft.trim() !== formatNumber(value)) return take(readNumber(draft));
    discard();
    return true;
  };
  const type = (text: string): void => {
    setDraft(text);
    const typed = live ? readNumber(text) : null;
    if (typed !== null && typed !== value && (refuse?.(typed) ?? null) === null) onCommit(typed);
  };
  return { draft, type, error, discard, take, commit };
}

/**
 * A number that can be typed as an expression. Enter and leaving the field commit it, Escape discards the text, and the
 * arrow keys change it by a step. An invalid text stays, with the reason.
 */
export function NumberField(props: NumberFieldProps) {
  const { label, value, step, leftSection, leftSectionWidth = 20, rightSection, testId } = props;
  const { draft, type, error, discard, take, commit } = useNumberDraft(props);
  const input = useRef<HTMLInputElement>(null);
  useFormField({ commit, focus: () => input.current?.focus() });
  const onKeyDown = (event: KeyboardEvent<HTMLInputElement>): void => {
    const direction = directions[event.key];
    if (direction !== undefined) {
      event.preventDefault();
      const base = draft === null ? value : (readNumber(draft) ?? value);
      take(Number((base + direction * stepOf(event, step)).toPrecision(12)));
    } else if (event.key === "Enter") commit();
    else if (event.key === "Escape" && (draft !== null || error !== null)) {
      event.stopPropagation();
      discard();
    }
  };
  return (
    <TextInput
      {...(leftSection !== undefined && { leftSection, leftSectionWidth })}
      {...(rightSection !== undefined && { rightSection })}
      ref={input}
      size="xs"
      aria-label={label}
      role="spinbutton"
      aria-valuenow={value}
      aria-valuetext={formatNumber(value)}
      autoComplete="off"
      spellCheck={false}
      data-testid={testId}
      data-autofocus={props.first || undefined}
      value={draft ?? formatNumber(value)}
      error={error}
      onChange={(event) => type(event.currentTarget.value)}
      onFocus={(event) => event.currentTarget.select()}
      onBlur={commit}
      onKeyDown={onKeyDown}
    />
  );
}
