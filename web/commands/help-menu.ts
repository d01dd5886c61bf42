import { commandLabels } from "../strings";
import { define, type Command } from "./command";

export const helpMenu: readonly Command[] = [
  define("help", 0)("lessons", commandLabels.lessons, (app) =>
    app.shell.setState({ rightTab: "lessons", drawer: "right" }),
  ),
  define("help", 0)(
    "present",
    commandLabels.present,
    (app) => app.shell.setState(({ isPresenting }) => ({ isPresenting: !isPresenting })),
    { checked: (app) => app.shell.getState().isPresenting },
  ),
  define("help", 0)("help", commandLabels.help, (app) => app.shell.setState({ dialog: "help" }), {
    keys: ["shift+?"],
  }),
];
