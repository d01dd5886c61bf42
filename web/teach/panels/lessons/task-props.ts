import type { LessonTask } from "../../lessons/lesson";

/** What the form of a task needs. */
export interface TaskProps<Task extends LessonTask> {
  readonly task: Task;
  readonly isDone: boolean;
  /** Place of the task in its lesson, from 1. */
  readonly number: number;
  /** Id of the element with the question. */
  readonly labelledBy: string;
  readonly onDone: () => void;
}
