import { useHotkeys, type HotkeyItem } from "@mantine/hooks";
import { useMemo } from "react";
import type { App } from "../app/app";
import { commands, runCommand } from "../commands/registry";
import { isPaletteOpen } from "./palette";

const noTags: string[] = [];
const fieldTags = ["INPUT", "TEXTAREA", "SELECT"];

/** The palette, a dialog or an open menu has its own keys. */
function isElsewhere(event: KeyboardEvent): boolean {
  if (isPaletteOpen()) return true;
  const target = event.target;
  return target instanceof Element && target.closest('[role="dialog"], [role="menu"]') !== null;
}

function itemsOf(app: App, inFields: boolean): HotkeyItem[] {
  return commands
    .filter((command) => command.inFields === inFields)
    .flatMap((command) =>
      command.keys.map((key): HotkeyItem => [
        key,
        (event) => {
          if (isElsewhere(event) || !command.enabled(app)) return;
          event.preventDefault();
          runCommand(app, command);
        },
        { preventDefault: false },
      ]),
    );
}

/** Makes the registry's hotkeys work. Single keys are off while a field has the focus. */
export function useCommandHotkeys(app: App): void {
  const everywhere = useMemo(() => itemsOf(app, true), [app]);
  const outsideFields = useMemo(() => itemsOf(app, false), [app]);
  useHotkeys(everywhere, noTags);
  useHotkeys(outsideFields, fieldTags);
}
