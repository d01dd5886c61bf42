import { getHotkeyHandler, type HotkeyItem } from "@mantine/hooks";
import { useEffect } from "react";
import type { App } from "../../app/app";
import { commands, runCommand } from "../../commands/registry";
import type { Command } from "../../commands/command";
import { frontCommands } from "../../commands/front-commands";
import { inputMode, isOfWidget } from "../../tools/input-mode";
import type { PageApps } from "../../tools/page-apps";
import { pageApps } from "../shared/page-apps";
import { isPaletteOpen } from "../shared/palette";

type Apps = Pick<PageApps<App>, "owns" | "contains">;

/** Returns whether a hotkey of the command works for an event with this target. */
function isMeant(app: App, apps: Apps, { inFields }: Command, target: EventTarget | null): boolean {
  if (isPaletteOpen() || !apps.owns(app, target)) return false;
  const mode = inputMode(target);
  // The page may have fields outside the app.
  return mode === "view" || (mode === "field" && inFields && apps.contains(app, target));
}

/**
 * Returns a listener for key events that runs the commands of an app: single keys only if no field has the
 * focus, and no commands in dialogs and menus.
 */
export function hotkeyListener(
  app: App,
  apps: Apps,
  among: readonly Command[] = commands,
): (event: KeyboardEvent) => void {
  const hotkeys = among.flatMap((command) =>
    command.keys.map((key): HotkeyItem => [
      key,
      (event) => {
        if (!isMeant(app, apps, command, event.target) || !command.enabled(app)) return;
        if (event.defaultPrevented || isOfWidget(event)) return;
        event.preventDefault();
        runCommand(app, command);
      },
      { preventDefault: false },
    ]),
  );
  return getHotkeyHandler(hotkeys);
}

/** Makes the hotkeys of all commands work. */
export const useCommandHotkeys = (app: App): void => useHotkeys(app, commands);

/** Makes the hotkeys of the player work, and no others. */
export const useFrontHotkeys = (app: App): void => useHotkeys(app, frontCommands);

function useHotkeys(app: App, among: readonly Command[]): void {
  useEffect(() => {
    const listener = hotkeyListener(app, pageApps, among);
    document.documentElement.addEventListener("keydown", listener);
    return () => document.documentElement.removeEventListener("keydown", listener);
  }, [app, among]);
}
