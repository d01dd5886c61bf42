import { UnstyledButton } from "@mantine/core";
import { IconBook2, IconCircleCheckFilled } from "@tabler/icons-react";
import { articleOf } from "../../article/articles";
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
          const article = articleOf(index + 1);
          return (
            <li key={lesson.id} className={styles["row"]}>
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
              {article !== null && (
                <a
                  className={styles["article"]}
                  href={article}
                  target="_blank"
                  rel="noopener"
                  title={texts.article}
                  aria-label={`${texts.article}: ${lesson.title}`}
                  data-testid={`article-${index + 1}`}
                >
                  <IconBook2 size={16} aria-hidden />
                </a>
              )}
            </li>
          );
        })}
      </ol>
      {errors.length > 0 && <LessonErrors errors={errors} />}
    </>
  );
}
