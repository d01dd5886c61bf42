import { getHotkeyHandler, type HotkeyItem } from "@mantine/hooks";
import { useEffect } from "react";
import type { App } from "../../app/app";
import { commands, hotkeysOf, runCommand } from "../../commands/registry";
import type { Command } from "../../commands/command";
import { closeMenus, inputMode, isOfWidget, takesChord } from "../../tools/input-mode";
import { isPaletteOpen } from "../shared/palette";

/** Returns whether a hotkey of the command works for an event. */
function isMeant({ inFields }: Command, { key, target }: KeyboardEvent): boolean {
  if (isPaletteOpen()) return false;
  const mode = inputMode(target);
  // The browser would open its own help.
  return mode === "view" || (mode === "field" && (inFields || key === "F1"));
}

/** Returns a handler of key events that calls `act` with the command of a key. */
const handlerOf = (
  among: readonly Command[],
  act: (command: Command, event: KeyboardEvent) => void,
): ((event: KeyboardEvent) => void) =>
  getHotkeyHandler(
    among.flatMap((command) =>
      hotkeysOf(command).map((key): HotkeyItem => [
        key,
        (event) => act(command, event),
        { preventDefault: false },
      ]),
    ),
  );

/**
 * Returns a listener for key events that runs the commands of an app: single keys only if no field has the
 * focus, and no commands in dialogs and menus.
 */
export function hotkeyListener(
  app: App,
  among: readonly Command[] = commands,
): (event: KeyboardEvent) => void {
  return handlerOf(among, (command, event) => {
    if (!isMeant(command, event) || !command.enabled(app)) return;
    if (event.defaultPrevented || isOfWidget(event)) return;
    event.preventDefault();
    runCommand(app, command);
  });
}

/**
 * Returns a listener for the capture phase, which runs the command of a chord before the button, menu or menu item that has
 * the focus can take its key: with Ctrl, Enter presses no button. Fields, trees and dialogs are left to `hotkeyListener`.
 */
export function chordListener(
  app: App,
  among: readonly Command[] = commands,
): (event: KeyboardEvent) => void {
  return handlerOf(among, (command, event) => {
    const { target } = event;
    if (!takesChord(event) || isPaletteOpen()) return;
    // Of a disabled command, only Enter is kept from a button: the browser may copy a text, for example.
    if (!command.enabled(app) && event.key !== "Enter") return;
    event.preventDefault();
    event.stopPropagation();
    closeMenus(target);
    runCommand(app, command);
  });
}

/** Makes the hotkeys of all commands work. */
export const useCommandHotkeys = (app: App): void => useHotkeys(app, commands);

/** Makes the hotkeys of some commands work, and no others. `among`: must not change. */
export function useHotkeys(app: App, among: readonly Command[]): void {
  useEffect(() => {
    const life = new AbortController();
    const { documentElement: root } = document;
    const capturing = { capture: true, signal: life.signal };
    root.addEventListener("keydown", chordListener(app, among), capturing);
    root.addEventListener("keydown", hotkeyListener(app, among), { signal: life.signal });
    return () => life.abort();
  }, [app, among]);
}
