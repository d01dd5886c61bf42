import { Button, Radio, TextInput } from "@mantine/core";
import { useState, type SyntheticEvent } from "react";
import { isRight, numberIn } from "../../lessons/check-task";
import type { TaskOf } from "../../lessons/lesson";
import { lessonStrings as texts } from "../../strings/lessons";
import styles from "./lessons.module.css";
import type { TaskProps } from "./task-props";

type Answered = TaskOf<"number"> | TaskOf<"choice">;

/** A question with a number or one of several texts as its answer. */
export function AnswerTask({ task, isDone, number, labelledBy, onDone }: TaskProps<Answered>) {
  const [answer, setAnswer] = useState("");
  const [verdict, setVerdict] = useState<string | null>(null);
  const change = (value: string): void => {
    setAnswer(value);
    setVerdict(null);
  };
  const check = (event: SyntheticEvent): void => {
    event.preventDefault();
    if (task.kind === "choice" && answer === "") setVerdict(texts.noChoice);
    else if (task.kind === "number" && numberIn(answer) === null) setVerdict(texts.noNumber);
    else if (isRight(task, answer)) {
      setVerdict(texts.right);
      onDone();
    } else setVerdict([texts.wrong, task.hint].filter(Boolean).join(" "));
  };
  const shown = verdict ?? (isDone ? texts.right : "");
  return (
    <form className={styles["answer"]} onSubmit={check} noValidate>
      {task.kind === "number" ? (
        <TextInput
          size="xs"
          inputMode="decimal"
          autoComplete="off"
          aria-label={texts.answer}
          aria-describedby={labelledBy}
          data-testid={`lesson-answer-${number}`}
          value={answer}
          onChange={(event) => change(event.currentTarget.value)}
        />
      ) : (
        <Radio.Group aria-labelledby={labelledBy} value={answer} onChange={change}>
          {task.choices.map((choice, index) => (
            <Radio
              key={choice}
              size="xs"
              value={choice}
              label={choice}
              data-testid={`lesson-choice-${number}-${index + 1}`}
            />
          ))}
        </Radio.Group>
      )}
      <Button type="submit" size="compact-xs" variant="default" data-testid={`lesson-check-${number}`}>
        {texts.check}
      </Button>
      <p
        role="status"
        data-testid={`lesson-verdict-${number}`}
        data-right={shown === texts.right || undefined}
      >
        {shown}
      </p>
    </form>
  );
}
