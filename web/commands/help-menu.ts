import { define, type Command } from "./command";

export const helpMenu: readonly Command[] = [
  define("help", 0)("help", "Keyboard and mouse", (app) => app.shell.setState({ dialog: "help" }), {
    keys: ["shift+?"],
  }),
];
