import type { App } from "../../app/app";
import type { PaletteItem, PaletteSource } from "../../commands/palette-items";
import { frontStrings as texts } from "../strings/front";
import { shareStrings } from "../strings/share";
import { playerOf } from "./player-of";

const sharing = {
  link: (app: App) => void import("./step-links").then(({ copyLink }) => copyLink(app)),
  embed: (app: App) => void import("./step-links").then(({ copyEmbedCode }) => copyEmbedCode(app)),
  picture: (app: App) => void import("./step-pictures").then(({ savePicture }) => savePicture(app)),
  drawing: (app: App) => void import("./step-pictures").then(({ saveDrawing }) => saveDrawing(app)),
  animation: (app: App) => void import("./step-pictures").then(({ saveAnimation }) => saveAnimation(app)),
} as const;

/** Returns what passes on the step of the front that is shown, as in the menu of the player. */
function sharingItems(app: App): PaletteItem[] {
  const hasFront = playerOf(app).state.getState().trace !== null;
  return (Object.keys(sharing) as (keyof typeof sharing)[]).map((id) => ({
    id: `share-step-${id}`,
    group: texts.group,
    label: shareStrings[id],
    words: texts.sharing[id],
    hotkey: null,
    needs: hasFront ? null : texts.needsFront,
    run: () => sharing[id](app),
  }));
}

/** Returns the step of the front whose number a query has, or how to ask for one: "step 100". */
function stepItems(app: App, query: string): PaletteItem[] {
  const { trace } = playerOf(app).state.getState();
  const { begin, label, words } = texts.goToStep;
  const item = { id: "go-to-step", group: texts.group, words, hotkey: null };
  const number = /\bstep\s+(\d+)\s*$/i.exec(query)?.[1];
  if (trace === null || number === undefined)
    return [
      {
        ...item,
        label: label(null, trace?.stepCount ?? null),
        needs: trace === null ? texts.needsFront : null,
        begins: begin,
        run: () => undefined,
      },
    ];
  const step = Number(number);
  if (step > trace.stepCount) return [];
  return [{ ...item, label: label(step, trace.stepCount), needs: null, run: () => playerOf(app).seek(step) }];
}

/** Titles of the lessons, null for one that cannot be read; null before they are loaded. */
let titles: readonly (string | null)[] | null = null;

/**
 * Returns the lessons. Before their titles are known, returns the one whose number a query has: "lesson 10". An unknown number
 * opens the list of lessons.
 */
function lessonItems(app: App, query: string): PaletteItem[] {
  const typed = Number(/\blesson\s+(\d+)\s*$/i.exec(query)?.[1] ?? 0);
  const known = titles?.map((title, index) => ({ title, number: index + 1 }));
  const lessons = known?.filter(({ title }) => title !== null) ?? [{ title: null, number: typed }];
  return lessons
    .filter(({ number }) => number > 0)
    .map(({ title, number }) => ({
      id: `lesson-${number}`,
      group: texts.lessons,
      label: texts.lesson(number, title),
      words: "",
      hotkey: null,
      needs: null,
      takesFocus: true,
      run: () => {
        app.shell.setState({ startPage: false });
        void import("./lesson-actions").then(({ openLessonNumber }) =>
          openLessonNumber(app, { number, runs: [], step: null }),
        );
      },
    }));
}

export const teachingItems: PaletteSource = {
  itemsOf: (app, query) => [...stepItems(app, query), ...lessonItems(app, query), ...sharingItems(app)],
  load: async () => {
    const { course } = await import("../lessons/course");
    titles = (await course()).lessons.map((lesson) => lesson?.title ?? null);
  },
};
