import type { App } from "../app/app";
import { keyWords } from "../strings";
import { booleanCommands } from "./boolean-commands";
import type { Command } from "./command";
import { createMenu } from "./create-menu";
import { solidCommands } from "./solid-commands";
import { editMenu } from "./edit-menu";
import { fileMenu } from "./file-menu";
import { helpMenu } from "./help-menu";
import { meshMenu } from "./mesh-menu";
import { toolCommands } from "./tool-commands";
import { pieceCommands, sweepCommands, transformCommands } from "./operation-commands";
import { viewMenu } from "./view-menu";

const all: Command[] = [
  ...fileMenu,
  ...editMenu,
  ...toolCommands.filter(({ menu }) => menu === "edit"),
  ...transformCommands,
  ...booleanCommands,
  ...toolCommands.filter(({ menu }) => menu === "create"),
  ...createMenu,
  ...pieceCommands,
  ...solidCommands,
  ...sweepCommands,
  ...viewMenu,
  ...toolCommands.filter(({ menu }) => menu === "view"),
  ...meshMenu,
  ...helpMenu,
];

/** Every command, in the order of the menus. */
export const commands: readonly Command[] = all;

/** A digit or sign: some keyboards type it with Shift, others without. */
const sign = /^(?:alt\+)?[^\p{L}\s]$/u;

const byId = new Map<string, Command>();
const byHotkey = new Map<string, Command>();
for (const command of all) register(command);

function register(command: Command): void {
  byId.set(command.id, command);
  for (const key of hotkeysOf(command)) byHotkey.set(key, command);
}

/** Adds commands of another part of the page, before it is shown. In their menu, they are the first of their section. */
export function addCommands(added: readonly Command[]): void {
  for (const command of added) {
    const { menu, section } = command;
    const isAfter = (other: Command): boolean =>
      other.menu === menu && other.section >= section && !added.includes(other);
    const at = all.findIndex(isAfter);
    all.splice(at < 0 ? all.findLastIndex((other) => other.menu === menu) + 1 : at, 0, command);
    register(command);
  }
}

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

/** Runs the command with an id if it is enabled. */
export const runNamed = (app: App, id: string): void => runCommand(app, commandNamed(id));

/** Returns the hotkeys of a command on all keyboards. */
export function hotkeysOf({ keys }: Command): readonly string[] {
  return keys.flatMap((key) => (sign.test(key) ? [key, `shift+${key}`] : [key]));
}

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
