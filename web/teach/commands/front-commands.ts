import type { App } from "../../app/app";
import { jump } from "../player/player";
import { commandLabels, paletteStrings } from "../../strings";
import { define, type Command, type Extra } from "../../commands/command";

const playerState = (app: App) => app.player.state.getState();
const hasTrace = (app: App): boolean => playerState(app).trace !== null;
/** For commands of a front that is shown. */
const needsFront: Extra = { enabled: hasTrace, needs: paletteStrings.needs.front };
const canRecord = (app: App): boolean =>
  playerState(app).recording === null && playerState(app).reading === null && !app.run.state.getState().busy;

/** Records the front of the present model; the tab shows the progress. */
function recordFront(app: App): void {
  app.shell.setState({ bottomTab: "front", drawer: "bottom" });
  void app.player.record({ optimizes: true });
}

/** The commands of the recorded front, in the menu of the mesh. */
export const frontCommands: readonly Command[] = [
  define("mesh", 4)("record-front", commandLabels.front.record, recordFront, { enabled: canRecord }),
  define("mesh", 4)("front-play", commandLabels.front.play, (app) => app.player.toggle(), {
    keys: ["Space"],
    ...needsFront,
  }),
  define("mesh", 4)("front-forward", commandLabels.front.forward, (app) => app.player.move(1), {
    keys: ["."],
    ...needsFront,
  }),
  define("mesh", 4)("front-back", commandLabels.front.back, (app) => app.player.move(-1), {
    keys: [","],
    ...needsFront,
  }),
  define("mesh", 4)(
    "front-far-forward",
    commandLabels.front.farForward(jump),
    (app) => app.player.move(jump),
    {
      // The second one is Shift and the key of the full stop on a German keyboard.
      keys: [">", "shift+:"],
      ...needsFront,
    },
  ),
  define("mesh", 4)("front-far-back", commandLabels.front.farBack(jump), (app) => app.player.move(-jump), {
    // On a German keyboard, < has a key of its own, and Shift and the key of the comma make a semicolon.
    keys: ["<", "shift+;"],
    ...needsFront,
  }),
  define("mesh", 4)("front-start", commandLabels.front.start, (app) => app.player.move(-Infinity), {
    keys: ["Home"],
    ...needsFront,
  }),
  define("mesh", 4)("front-end", commandLabels.front.end, (app) => app.player.move(Infinity), {
    keys: ["End"],
    ...needsFront,
  }),
  define("mesh", 4)("front-close", commandLabels.front.close, (app) => app.player.close(), {
    ...needsFront,
  }),
];
