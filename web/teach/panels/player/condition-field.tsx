import { TextInput } from "@mantine/core";
import { useId, type KeyboardEvent } from "react";
import { parseCondition } from "../../player/condition";
import { playerStrings } from "../../strings/player";
import styles from "./player.module.css";

const texts = playerStrings.condition;

interface ConditionFieldProps {
  readonly text: string;
  readonly onChange: (text: string) => void;
  /** Goes to the next or previous step that meets the condition. */
  readonly onJump: (direction: 1 | -1) => void;
}

/** A condition as text. Enter jumps to the next step that meets it, Shift and Enter to the previous one. */
export function ConditionField({ text, onChange, onJump }: ConditionFieldProps) {
  const hint = useId();
  const parsed = parseCondition(text);
  const error = parsed.success || text.trim() === "" ? null : texts.error(parsed.error);
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.key !== "Enter") return;
    event.preventDefault();
    onJump(event.shiftKey ? -1 : 1);
  };
  return (
    <span className={styles["condition"]}>
      <TextInput
        size="xs"
        className={styles["condition-input"]}
        aria-label={texts.label}
        aria-describedby={hint}
        error={error !== null}
        withErrorStyles={false}
        data-testid="player-condition"
        placeholder={texts.placeholder}
        value={text}
        classNames={{ input: error === null ? "" : (styles["wrong-input"] ?? "") }}
        spellCheck={false}
        autoCapitalize="off"
        onChange={(event) => onChange(event.currentTarget.value)}
        onKeyDown={onKeyDown}
      />
      <span
        id={hint}
        role={error === null ? undefined : "alert"}
        className={error === null ? styles["hint"] : styles["wrong"]}
        data-testid="player-condition-hint"
      >
        {error ?? texts.hint}
      </span>
    </span>
  );
}
