import { UnstyledButton } from "@mantine/core";
import { IconCircleCheckFilled } from "@tabler/icons-react";
import { openLesson } from "../../commands/lesson-actions";
import { isFinished } from "../../lessons/course";
import type { Course } from "../../lessons/lesson-files";
import { lessonStrings as texts } from "../../strings/lessons";
import { useApp } from "../../../panels/shared/app-context";
import { LessonErrors } from "./lesson-errors";
import styles from "./lessons.module.css";
import { useProgress } from "./use-lessons";

/** All lessons with what is done of each, and the errors of files that are no lessons. */
export function LessonList({ course: { lessons, errors } }: { readonly course: Course }) {
  const app = useApp();
  const progress = useProgress();
  return (
    <>
      <ol className={styles["list"]}>
        {lessons.map((lesson, index) => {
          if (!lesson) return null;
          const done = lesson.tasks.filter((_, task) => progress[lesson.id]?.includes(task)).length;
          return (
            <li key={lesson.id}>
              <UnstyledButton
                className={styles["entry"]}
                data-testid={`lesson-${index + 1}`}
                onClick={() => void openLesson(app, lesson, index + 1)}
              >
                <span className={styles["number"]}>{index + 1}</span>
                <span>{lesson.title}</span>
                <span className={styles["state"]} data-done={isFinished(lesson, progress) || undefined}>
                  {isFinished(lesson, progress) && <IconCircleCheckFilled size={14} aria-hidden />}
                  {done > 0 && texts.done(done, lesson.tasks.length)}
                </span>
              </UnstyledButton>
            </li>
          );
        })}
      </ol>
      {errors.length > 0 && <LessonErrors errors={errors} />}
    </>
  );
}
