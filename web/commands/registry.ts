import type { App } from "../app/app";
import { keyWords, paletteStrings } from "../strings";
import { booleanCommands } from "./boolean-commands";
import type { Command } from "./command";
import { createMenu } from "./create-menu";
import { editMenu } from "./edit-menu";
import { fileMenu } from "./file-menu";
import { frontCommands } from "../teach/commands/front-commands";
import { helpMenu } from "./help-menu";
import { meshMenu } from "./mesh-menu";
import { toolCommands } from "./tool-commands";
import { pieceCommands, sweepCommands, transformCommands } from "./operation-commands";
import { viewMenu } from "./view-menu";

/** Commands that make or change entities are not for the model of a lesson. */
const editing = (commands: readonly Command[]): readonly Command[] =>
  commands.map((command) => ({
    ...command,
    enabled: (app) => !app.isLessonModel && command.enabled(app),
    needs: (app) => (app.isLessonModel ? paletteStrings.needs.ownModel : command.needs(app)),
  }));

/** Tools that change entities and stand in menus among others: without them, the view of a lesson has no armed editor. */
const armed: ReadonlySet<string> = new Set(["tool-move", "tool-node", "tool-source", "paint-size"]);

/** Every command, in the order of the menus. */
export const commands: readonly Command[] = [
  ...fileMenu,
  ...editMenu,
  ...toolCommands.filter(({ menu }) => menu === "edit"),
  ...editing([
    ...transformCommands,
    ...booleanCommands,
    ...toolCommands.filter(({ menu }) => menu === "create"),
    ...createMenu,
    ...pieceCommands,
    ...sweepCommands,
  ]),
  ...viewMenu,
  ...toolCommands.filter(({ menu }) => menu === "view"),
  ...meshMenu,
  ...frontCommands,
  ...helpMenu,
].flatMap((command) => (armed.has(command.id) ? editing([command]) : [command]));

const byId = new Map(commands.map((command) => [command.id, command]));

/** Returns whether there is a command with an id. */
export const hasCommand = (id: string): boolean => byId.has(id);

/** Returns the command with an id; throws if there is none. */
export function commandNamed(id: string): Command {
  const command = byId.get(id);
  if (!command) throw new Error(`There is no command "${id}"`);
  return command;
}

/** Commands that have nothing to do with the model beside the start page, or close the page themselves. */
const isBesideStart = ({ id, menu }: Command): boolean =>
  menu === "file" || menu === "help" || id.startsWith("scheme-");

/** Runs a command if it is enabled. One that works with the model closes the start page, which covers a part of the view. */
export function runCommand(app: App, command: Command): void {
  if (!command.enabled(app)) return;
  if (!isBesideStart(command)) app.shell.setState({ startPage: false });
  command.run(app);
}

/** A digit or sign: some keyboards type it with Shift, others without. */
const sign = /^(?:alt\+)?[^\p{L}\s]$/u;

/** Returns the hotkeys of a command on all keyboards. */
export const hotkeysOf = ({ keys }: Command): readonly string[] =>
  keys.flatMap((key) => (sign.test(key) ? [key, `shift+${key}`] : [key]));

const byHotkey = new Map(
  commands.flatMap((command) => hotkeysOf(command).map((key) => [key, command] as const)),
);

/** Returns the command that a key runs without Ctrl and Alt; undefined if there is none. */
export const commandOfKey = ({
  key,
  shiftKey,
}: Pick<KeyboardEvent, "key" | "shiftKey">): Command | undefined =>
  byHotkey.get(shiftKey ? `shift+${key.toUpperCase()}` : key.toUpperCase());

/** Returns the names of a hotkey's keys as printed on a keyboard: "mod+shift+Z" becomes Ctrl, Shift, Z. */
export function keyNames(key: string): readonly string[] {
  return key.split("+").map((part) => keyWords[part] ?? part);
}
