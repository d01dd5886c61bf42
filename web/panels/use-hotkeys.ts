import { useHotkeys, type HotkeyItem } from "@mantine/hooks";
import { useMemo } from "react";
import type { App } from "../app/app";
import { commands, runCommand } from "../commands/registry";
import type { Command } from "../commands/command";
import { inputMode } from "../tools/input-mode";
import { isPaletteOpen } from "./palette";

/** `hotkeysOf` decides by the input mode; Mantine must not skip fields by itself. */
const noTags: string[] = [];

/** Returns whether a hotkey of the command works for this event. */
function isMeant({ inFields }: Command, event: KeyboardEvent): boolean {
  if (isPaletteOpen()) return false;
  const mode = inputMode(event.target);
  return mode === "view" || (mode === "field" && inFields);
}

function hotkeysOf(app: App): HotkeyItem[] {
  return commands.flatMap((command) =>
    command.keys.map((key): HotkeyItem => [
      key,
      (event) => {
        if (!isMeant(command, event) || !command.enabled(app)) return;
        event.preventDefault();
        runCommand(app, command);
      },
      { preventDefault: false },
    ]),
  );
}

/** Makes the hotkeys of all commands work: single keys while no field has the focus, none in dialogs and menus. */
export function useCommandHotkeys(app: App): void {
  const hotkeys = useMemo(() => hotkeysOf(app), [app]);
  useHotkeys(hotkeys, noTags);
}
