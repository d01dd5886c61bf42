import { IconCircle, IconCircleCheckFilled } from "@tabler/icons-react";
import type { ReactNode } from "react";
import { finishTask } from "../../lessons/course";
import type { Lesson, LessonTask } from "../../lessons/lesson";
import { playerStrings } from "../../strings/player";
import { lessonStrings as texts } from "../../strings/lessons";
import { AnswerTask } from "./answer-task";
import { CompareTask } from "./compare-task";
import { LessonText } from "./lesson-text";
import styles from "./lessons.module.css";
import type { TaskProps } from "./task-props";
import { useProgress } from "./use-lessons";

/** The tasks of a lesson; the app checks each. */
export function TaskList({ lesson }: { readonly lesson: Lesson }) {
  const done = useProgress()[lesson.id] ?? [];
  return (
    <section aria-label={texts.tasks}>
      <h3 className={styles["subheading"]}>{texts.tasks}</h3>
      <ol className={styles["tasks"]}>
        {lesson.tasks.map((task, index) => {
          const isDone = done.includes(index);
          return (
            // Tasks have no identity beside their place.
            <li
              key={index}
              className={styles["task"]}
              data-testid={`lesson-task-${index + 1}`}
              data-done={isDone}
            >
              <span className={styles["mark"]} data-done={isDone || undefined}>
                {isDone ? (
                  <IconCircleCheckFilled size={16} role="img" aria-label={texts.taskDone} />
                ) : (
                  <IconCircle size={16} role="img" aria-label={texts.taskOpen} />
                )}
              </span>
              <div>
                <div id={`${lesson.id}-task-${index + 1}`}>
                  <LessonText text={task.ask} />
                </div>
                <TaskForm
                  task={task}
                  isDone={isDone}
                  number={index + 1}
                  labelledBy={`${lesson.id}-task-${index + 1}`}
                  onDone={() => finishTask(lesson, index)}
                />
                <div role="status" className={styles["because"]}>
                  {isDone && task.because !== undefined && <LessonText text={task.because} />}
                </div>
              </div>
            </li>
          );
        })}
      </ol>
    </section>
  );
}

function TaskForm(props: TaskProps<LessonTask>): ReactNode {
  const { task } = props;
  switch (task.kind) {
    case "step":
      return <p className={styles["how"]}>{texts.reach(task.reach)}</p>;
    case "color":
      return <p className={styles["how"]}>{texts.color(playerStrings.colorings[task.coloring])}</p>;
    case "number":
    case "choice":
      return <AnswerTask {...props} task={task} />;
    case "compare":
      return <CompareTask {...props} task={task} />;
  }
}
