import type { App } from "../../app/app";
import { jump } from "../player/player";
import { frontStrings } from "../strings/front";
import { define, type Command, type Extra } from "../../commands/command";
import { playerOf } from "./player-of";

const { commands: texts, words } = frontStrings;

const playerState = (app: App) => playerOf(app).state.getState();
const hasTrace = (app: App): boolean => playerState(app).trace !== null;
/** For commands of a front that is shown. */
const needsFront: Extra = { enabled: hasTrace, needs: frontStrings.needsFront };
const canRecord = (app: App): boolean =>
  playerState(app).recording === null && playerState(app).reading === null && !app.run.state.getState().busy;

/** Records the front of the present model; the tab shows the progress. */
function recordFront(app: App): void {
  app.shell.setState({ bottomTab: "front", drawer: "bottom" });
  void playerOf(app).record({ optimizes: true });
}

/** Opens the page of a lesson, or the list of all, beside the app. */
export const openLessons = (page?: number | "mesher"): void =>
  void window.open(page === undefined ? "./lessons/" : `./lessons/${page}/`, "_blank", "noopener");

/** The command of the lessons, in the menu of the help. */
export const lessonCommands: readonly Command[] = [
  define("help", 0)("lessons", texts.lessons, () => openLessons(), { words: words.lessons }),
  define("help", 0)("mesher", texts.mesher, () => openLessons("mesher"), { words: words.mesher }),
];

/** The commands of the recorded front, in the menu of the mesh. */
export const frontCommands: readonly Command[] = [
  define("mesh", 4)("record-front", texts.record, recordFront, { enabled: canRecord }),
  define("mesh", 4)("front-play", texts.play, (app) => playerOf(app).toggle(), {
    words: words.play,
    keys: ["Space"],
    ...needsFront,
  }),
  define("mesh", 4)("front-forward", texts.forward, (app) => playerOf(app).move(1), {
    keys: ["."],
    ...needsFront,
  }),
  define("mesh", 4)("front-back", texts.back, (app) => playerOf(app).move(-1), {
    keys: [","],
    ...needsFront,
  }),
  define("mesh", 4)("front-far-forward", texts.farForward(jump), (app) => playerOf(app).move(jump), {
    // The second one is Shift and the key of the full stop on a German keyboard.
    keys: [">", "shift+:"],
    ...needsFront,
  }),
  define("mesh", 4)("front-far-back", texts.farBack(jump), (app) => playerOf(app).move(-jump), {
    // On a German keyboard, < has a key of its own, and Shift and the key of the comma make a semicolon.
    keys: ["<", "shift+;"],
    ...needsFront,
  }),
  define("mesh", 4)("front-start", texts.start, (app) => playerOf(app).move(-Infinity), {
    words: words.start,
    keys: ["Home"],
    ...needsFront,
  }),
  define("mesh", 4)("front-end", texts.end, (app) => playerOf(app).move(Infinity), {
    words: words.end,
    keys: ["End"],
    ...needsFront,
  }),
  define("mesh", 4)("front-close", texts.close, (app) => playerOf(app).close(), {
    ...needsFront,
  }),
];
