import { TextInput } from "@mantine/core";
import { useContext, useLayoutEffect, useRef, useState, type KeyboardEvent, type ReactNode } from "react";
import { LENGTH_UNITS } from "tetrafront";
import {
  isPlainNumber,
  readNumber,
  unitKey,
  unitsIn,
  unknownNameIn,
  type NamedNumbers,
} from "../../expressions/expression";
import { useFormField } from "../frames/dialog-form";
import { NamedNumbersContext } from "./named-numbers";
import { formatNumber } from "../../strings/format";
import { strings } from "../../strings";

/** New values of all numbers that a field stands for. */
export interface OwnValues {
  readonly values: readonly number[];
  readonly commit: () => void;
}

/** Changes of the numbers that a field stands for, each from the value that it has. */
export interface OwnNumber {
  /** Returns what an expression such as `z+0.1` gives: null if that is no number, undefined if it uses no own values. */
  readonly read: (text: string) => OwnValues | null | undefined;
  /** Returns what a step gives; null if not all have a value. Then an arrow key changes nothing. */
  readonly step: (change: number) => OwnValues | null;
}

export interface NumberFieldProps {
  /** Label for screen readers; the row around the field shows a label of its own. */
  readonly label: string;
  /** Null if the field stands for several numbers that differ. */
  readonly value: number | null;
  /** What stands in the field if the value is null. Default: that the numbers differ. */
  readonly placeholder?: string;
  /** What the number was computed from. The field shows it while it has the focus. */
  readonly expression?: string | undefined;
  /** Change per press of an arrow key. Shift multiplies it by 10, Alt by 0.1. */
  readonly step: number;
  /** Fewer digits are filled with zeros in front. */
  readonly minDigits?: number;
  /** Returns why a number is invalid, or null if it is valid. */
  readonly refuse?: (value: number) => string | null;
  /** The expression is what was typed, if it is not a plain number. */
  readonly onCommit: (value: number, expression: string | null) => void;
  /** Changes from each entity's own value: by expressions, and by steps where the values differ. */
  readonly own?: OwnNumber | undefined;
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

/** Returns the text of a number that is not being typed. */
const textOf = (value: number | null, minDigits = 0): string =>
  value === null ? "" : formatNumber(value).padStart(minDigits, "0");

/** Returns why a text is no number. `isOwn`: it may use the names of own values. */
function problemOf(text: string, named: NamedNumbers, isOwn: boolean): string {
  const lacksUnit = [...unitsIn(text)].some(
    (word) => LENGTH_UNITS.some((unit) => unit === word) && !named.has(unitKey(word)),
  );
  if (lacksUnit) return strings.fields.noProjectUnit;
  const unknown = isOwn ? undefined : unknownNameIn(text, named);
  return unknown === undefined ? strings.fields.notANumber : strings.fields.unknownName(unknown);
}

/** Returns a typed text if it is an expression; null for a plain number. */
const keptFrom = (text: string): string | null => (text === "" || isPlainNumber(text) ? null : text);

/** The text that is being typed into a number field; null if the field shows its value. */
function useNumberDraft(
  { value, expression, minDigits, refuse, live = false, own, onCommit }: NumberFieldProps,
  isFocused: boolean,
) {
  const named = useContext(NamedNumbersContext);
  const [draft, setDraft] = useState<string | null>(null);
  const [error, setError] = useState<string | null>(null);
  const shown = textOf(value, minDigits);
  const resting = isFocused ? (expression ?? shown) : shown;
  const discard = (): void => {
    setDraft(null);
    setError(null);
  };
  /** Commits a number, unless it is invalid: then returns false and keeps the text, with the reason. */
  const take = (next: number | null, text = ""): boolean => {
    const reason = next === null ? problemOf(text, named, false) : (refuse?.(next) ?? null);
    setError(reason);
    if (next === null || reason !== null) return false;
    setDraft(null);
    const kept = keptFrom(text);
    if (next !== value || kept !== (expression ?? null)) onCommit(next, kept);
    return true;
  };
  /** As `take`, for new values of all numbers that the field stands for. */
  const takeOwn = (change: OwnValues | null, text = ""): boolean => {
    const reasons = change?.values.map((one) => refuse?.(one) ?? null) ?? [problemOf(text, named, true)];
    const reason = reasons.find((one) => one !== null) ?? null;
    setError(reason);
    if (change === null || reason !== null) return false;
    setDraft(null);
    change.commit();
    return true;
  };
  const commit = (): boolean => {
    if (draft === null) return true;
    const text = draft.trim();
    if (text !== (expression ?? shown)) {
      const change = own?.read(text);
      return change === undefined ? take(readNumber(text, named), text) : takeOwn(change, text);
    }
    discard();
    return true;
  };
  const type = (text: string): void => {
    setDraft(text);
    const typed = live ? readNumber(text, named) : null;
    const kept = keptFrom(text.trim());
    const isNew = typed !== value || kept !== (expression ?? null);
    if (typed !== null && isNew && (refuse?.(typed) ?? null) === null) onCommit(typed, kept);
  };
  const step = (change: number): boolean => {
    // What was typed in terms of own values counts, before any step.
    if (draft !== null && own?.read(draft.trim()) !== undefined) return commit();
    const from = (draft === null ? null : readNumber(draft, named)) ?? value;
    if (from !== null) return take(Number((from + change).toPrecision(12)));
    const stepped = own?.step(change) ?? null;
    return stepped !== null && takeOwn(stepped);
  };
  // A field that commits while it is typed in has nothing to discard once it has committed.
  const isCommitted =
    live &&
    draft !== null &&
    readNumber(draft, named) === value &&
    keptFrom(draft.trim()) === (expression ?? null);
  return {
    text: draft ?? resting,
    canDiscard: draft !== null && !isCommitted,
    type,
    error,
    discard,
    step,
    commit,
  };
}

/**
 * A number that can be typed as an expression. Enter and leaving the field commit it, Escape discards text that is not
 * committed, and the arrow keys change it by a step. An invalid text stays, with the reason.
 */
export function NumberField(props: NumberFieldProps) {
  const { label, value, expression, step, leftSection, leftSectionWidth = 20, rightSection, testId } = props;
  const [isFocused, setFocused] = useState(false);
  const draft = useNumberDraft(props, isFocused);
  const input = useRef<HTMLInputElement>(null);
  useFormField({ commit: draft.commit, focus: () => input.current?.focus() });
  useLayoutEffect(() => {
    // The expression has replaced the value.
    if (isFocused) input.current?.select();
  }, [isFocused]);
  const onKeyDown = (event: KeyboardEvent<HTMLInputElement>): void => {
    const direction = directions[event.key];
    if (direction !== undefined) {
      event.preventDefault();
      draft.step(direction * stepOf(event, step));
    } else if (event.key === "Enter") draft.commit();
    else if (event.key === "Escape" && (draft.canDiscard || draft.error !== null)) {
      event.stopPropagation();
      draft.discard();
    }
  };
  return (
    <TextInput
      {...(leftSection !== undefined && { leftSection, leftSectionWidth })}
      {...(rightSection !== undefined && { rightSection })}
      {...(expression !== undefined && { title: `${expression} = ${textOf(value)}` })}
      {...(value !== null && { "aria-valuenow": value, "aria-valuetext": textOf(value, props.minDigits) })}
      {...(value === null && { placeholder: props.placeholder ?? strings.fields.different })}
      ref={input}
      size="xs"
      aria-label={label}
      role="spinbutton"
      autoComplete="off"
      spellCheck={false}
      data-testid={testId}
      data-expression={expression}
      data-autofocus={props.first || undefined}
      value={draft.text}
      error={draft.error}
      onChange={(event) => draft.type(event.currentTarget.value)}
      onFocus={() => setFocused(true)}
      onBlur={() => {
        setFocused(false);
        draft.commit();
      }}
      onKeyDown={onKeyDown}
    />
  );
}
