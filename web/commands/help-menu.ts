import { commandLabels, paletteStrings } from "../strings";
import { canWorkOffline } from "../session/service-worker";
import { define, type Command } from "./command";
import { keepOffline } from "./offline-actions";

export const helpMenu: readonly Command[] = [
  define("help", 0)(
    "present",
    commandLabels.present,
    (app) => app.shell.setState(({ isPresenting }) => ({ isPresenting: !isPresenting })),
    { checked: (app) => app.shell.getState().isPresenting },
  ),
  define("help", 0)("help", commandLabels.help, (app) => app.shell.setState({ dialog: "help" }), {
    keys: ["?", "F1"],
  }),
  define("help", 1)("keep-offline", commandLabels.keepOffline, (app) => void keepOffline(app), {
    enabled: () => canWorkOffline(),
    needs: paletteStrings.needs.offline,
  }),
];
