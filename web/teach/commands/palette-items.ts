import type { App } from "../../app/app";
import type { PaletteItem, PaletteSource } from "../../commands/palette-items";
import { frontStrings as texts } from "../strings/front";
import { shareStrings } from "../strings/share";
import { openLessons } from "./front-commands";
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

/** Number of the last lesson; the first one is lesson 0. */
const lastLesson = 11;

/** Returns the lesson whose number a query has: "lesson 10". */
function lessonItems(query: string): PaletteItem[] {
  const number = Number(/\blesson\s+(\d+)\s*$/i.exec(query)?.[1] ?? NaN);
  if (!(number <= lastLesson)) return [];
  const item = { id: `lesson-${number}`, group: texts.lessons, label: texts.lesson(number), words: "" };
  return [{ ...item, hotkey: null, needs: null, run: () => openLessons(number) }];
}

export const teachingItems: PaletteSource = (app, query) => [
  ...stepItems(app, query),
  ...lessonItems(query),
  ...sharingItems(app),
];
