import { Button } from "@mantine/core";
import { IconChevronLeft, IconChevronRight, IconList, IconPrinter } from "@tabler/icons-react";
import { useEffect, useMemo, useRef } from "react";
import type { App } from "../../../app/app";
import { playerOf } from "../../commands/player-of";
import {
  closeLesson,
  lessonRuns,
  openLesson,
  showBeginning,
  showLessonModel,
} from "../../commands/lesson-actions";
import { isFinished, restart } from "../../lessons/course";
import { frontErrors } from "../../lessons/front-errors";
import type { Lesson } from "../../lessons/lesson";
import { lessonBeside, type Course } from "../../lessons/lesson-files";
import { showOwnRun } from "../../lessons/own-run";
import { lessonStrings as texts } from "../../strings/lessons";
import { ScrollPanel } from "../../../ui/frames/scroll-panel";
import { IconButton } from "../../../ui/icon-button";
import { usePlayer } from "../player/use-player";
import { useApp } from "../../../panels/shared/app-context";
import { Experiments } from "./experiments";
import { LessonErrors } from "./lesson-errors";
import { LessonPlayer } from "./lesson-player";
import { LessonText } from "./lesson-text";
import styles from "./lessons.module.css";
import { usePrintedLesson } from "./printed-lesson";
import { QueueFigure } from "./queue-figure";
import { SearchChart } from "./search-chart";
import { isFocusLost } from "../../../ui/use-focus-return";
import { StopRun } from "./stop-run";
import { TaskList } from "./task-list";
import { useLessonRuns, useProgress } from "./use-lessons";

const icon = { size: 15, "aria-hidden": true } as const;

export interface LessonPageProps {
  readonly lesson: Lesson;
  /** Place of the lesson in the course, from 1. */
  readonly number: number;
  readonly course: Course;
}

/** A lesson: its text, its figure and its tasks. */
export function LessonPage({ lesson, number, course }: LessonPageProps) {
  const heading = useRef<HTMLHeadingElement>(null);
  usePrintedLesson(useApp(), heading);
  // The button that has opened the lesson is gone: the keys go on from the title.
  useEffect(() => heading.current?.focus({ preventScroll: true }), []);
  return (
    <ScrollPanel
      label={texts.name(number, lesson.title)}
      className={styles["page"]}
      data-testid="lesson-page"
      data-lesson={number}
    >
      <LessonBar number={number} course={course} />
      <h2 ref={heading} tabIndex={-1} className={styles["heading"]}>
        {texts.name(number, lesson.title)}
      </h2>
      <p className={styles["source"]}>
        <a href={texts.paperLink} target="_blank" rel="noreferrer">
          {texts.paper}
        </a>
        , {texts.section(lesson.paper)}
      </p>
      <FrontState lesson={lesson} />
      <FrontErrors lesson={lesson} />
      <LessonPlayer />
      <LessonText text={lesson.text} />
      {lesson.figure.includes("queue") && <QueueFigure />}
      {lesson.figure.includes("search-cost") && <SearchChart />}
      <TaskList lesson={lesson} />
      <Experiments key={lesson.id} lesson={lesson} />
      <Finished lesson={lesson} number={number} course={course} />
    </ScrollPanel>
  );
}

function LessonBar({ number, course }: Omit<LessonPageProps, "lesson">) {
  const app = useApp();
  const [previous, next] = [lessonBeside(course, number, -1), lessonBeside(course, number, 1)];
  const open = (to: number | null): void => {
    const lesson = to === null ? null : course.lessons[to - 1];
    if (to !== null && lesson) void openLesson(app, lesson, to);
  };
  return (
    <nav className={styles["bar"]} aria-label={texts.title}>
      <Button
        size="compact-xs"
        variant="subtle"
        color="gray"
        leftSection={<IconList {...icon} />}
        data-testid="lesson-all"
        onClick={() => closeLesson(app)}
      >
        {texts.all}
      </Button>
      <span>
        <IconButton label={texts.print} data-testid="lesson-print" onClick={() => window.print()}>
          <IconPrinter {...icon} />
        </IconButton>
        <IconButton
          label={texts.previous}
          data-testid="lesson-previous"
          disabled={previous === null}
          onClick={() => open(previous)}
        >
          <IconChevronLeft {...icon} />
        </IconButton>
        <IconButton
          label={texts.next}
          data-testid="lesson-next"
          disabled={next === null}
          onClick={() => open(next)}
        >
          <IconChevronRight {...icon} />
        </IconButton>
      </span>
    </nav>
  );
}

/** Shows the state in which a lesson begins, in its own run. */
function goToBeginning(app: App, lesson: Lesson): void {
  showOwnRun(playerOf(app), lessonRuns(app).getState().runs);
  showBeginning(app, lesson);
}

/** The errors of a lesson that only its front shows. */
function FrontErrors({ lesson }: { readonly lesson: Lesson }) {
  const own = useLessonRuns((state) =>
    state.lesson === lesson ? state.runs.find(({ name }) => name === "") : undefined,
  );
  const errors = useMemo(() => (own ? frontErrors(lesson, own.trace) : []), [lesson, own]);
  return errors.length > 0 && <LessonErrors errors={errors} />;
}

/** Says if the view shows something else than the front of the lesson, and brings it back. */
function FrontState({ lesson }: { readonly lesson: Lesson }) {
  const app = useApp();
  const shown = usePlayer((state) => state.trace);
  const { runs, isPreparing, lesson: prepared } = useLessonRuns((state) => state);
  const isRecording = usePlayer((state) => state.recording !== null);
  const isShown = prepared === lesson && runs.some(({ trace }) => trace === shown);
  const show = useRef<HTMLButtonElement>(null);
  const isStopped = useRef(false);
  useEffect(() => {
    if (isPreparing || !isStopped.current) return;
    isStopped.current = false;
    // The button that was pressed is gone; this one stands in its place.
    if (isFocusLost()) show.current?.focus();
  }, [isPreparing]);
  if (isPreparing)
    return (
      <div className={styles["front"]} data-unprinted>
        <span role="status">{texts.preparing}</span>
        {isRecording && <StopRun testId="lesson-stop" onStop={() => (isStopped.current = true)} />}
      </div>
    );
  return (
    <p className={styles["front"]} data-testid="lesson-front" data-shown={isShown} data-unprinted>
      {!isShown && `${texts.otherModel} `}
      <Button
        ref={show}
        size="compact-xs"
        variant="default"
        data-testid="lesson-show"
        onClick={() => (isShown ? goToBeginning(app, lesson) : void showLessonModel(app, lesson))}
      >
        {isShown ? texts.goTo : texts.show}
      </Button>
    </p>
  );
}

function Finished({ lesson, number, course }: LessonPageProps) {
  const app = useApp();
  const following = lessonBeside(course, number, 1);
  const next = following === null ? null : course.lessons[following - 1];
  const done = isFinished(lesson, useProgress());
  return (
    <div className={styles["end"]} role="status">
      {done && (
        <>
          <p data-testid="lesson-finished">{texts.finished}</p>
          {following !== null && next && (
            <Button
              size="compact-sm"
              rightSection={<IconChevronRight {...icon} />}
              onClick={() => void openLesson(app, next, following)}
            >
              {texts.next}
            </Button>
          )}{" "}
          <Button
            size="compact-sm"
            variant="default"
            onClick={() => {
              restart(lesson);
              goToBeginning(app, lesson);
            }}
          >
            {texts.restart}
          </Button>
        </>
      )}
    </div>
  );
}
