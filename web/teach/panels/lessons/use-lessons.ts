import { useEffect, useState } from "react";
import { useStore } from "zustand";
import { lessonRuns, type LessonRuns } from "../../commands/lesson-actions";
import { course, progress, type Progress } from "../../lessons/course";
import type { Course } from "../../lessons/lesson-files";
import { useApp } from "../../../panels/shared/app-context";

export interface LoadedCourse {
  /** Null while it is being loaded, and after a failure. */
  readonly course: Course | null;
  readonly failure: string | null;
  readonly retry: () => void;
}

/** Loads the lessons when it is first used. */
export function useCourse(): LoadedCourse {
  const [loaded, setLoaded] = useState<Course | null>(null);
  const [failure, setFailure] = useState<string | null>(null);
  const [attempt, setAttempt] = useState(0);
  useEffect(() => {
    let isOver = false;
    setFailure(null);
    course().then(
      (value) => {
        if (!isOver) setLoaded(value);
      },
      (error: unknown) => {
        if (!isOver) setFailure(error instanceof Error ? error.message : String(error));
      },
    );
    return () => {
      isOver = true;
    };
  }, [attempt]);
  return { course: loaded, failure, retry: () => setAttempt(attempt + 1) };
}

export function useProgress(): Progress {
  return useStore(progress);
}

export function useLessonRuns<T>(select: (state: LessonRuns) => T): T {
  return useStore(lessonRuns(useApp()), select);
}
