import { lessonStrings as texts } from "../../strings/lessons";
import styles from "./lessons.module.css";

/** What is wrong with the files of lessons, for those who write them. */
export function LessonErrors({ errors }: { readonly errors: readonly string[] }) {
  return (
    <div role="alert" className={styles["errors"]} data-testid="lesson-errors">
      <b>{texts.errors(errors.length)}</b>
      {errors.map((error) => (
        <p key={error}>{error}</p>
      ))}
    </div>
  );
}
