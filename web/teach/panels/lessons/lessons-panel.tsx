import { Button, Text } from "@mantine/core";
import { lessonStrings as texts } from "../../strings/lessons";
import { useStore } from "zustand";
import { useApp } from "../../../panels/shared/app-context";
import { openLessonOf } from "../../commands/open-lesson";
import { ScrollPanel } from "../../../ui/frames/scroll-panel";
import { LessonList } from "./lesson-list";
import { LessonPage } from "./lesson-page";
import { useCourse } from "./use-lessons";

/** The list of the lessons, or the open one. */
export function LessonsPanel() {
  const { course, failure, retry } = useCourse();
  const number = useStore(openLessonOf(useApp()), (state) => state.number);
  const lesson = number === null ? undefined : course?.lessons[number - 1];
  if (course && lesson && number !== null)
    return <LessonPage key={lesson.id} lesson={lesson} number={number} course={course} />;
  return (
    <ScrollPanel label={texts.title} data-testid="lesson-list">
      <Text size="sm" c="dimmed" mb="xs">
        {texts.intro}
      </Text>
      {course && <LessonList course={course} />}
      {!course && failure === null && <Text size="sm">{texts.loading}</Text>}
      {failure !== null && (
        <div role="alert">
          <Text size="sm" mb={6}>
            {texts.failed(failure)}
          </Text>
          <Button size="compact-sm" variant="default" onClick={retry}>
            {texts.retry}
          </Button>
        </div>
      )}
    </ScrollPanel>
  );
}
