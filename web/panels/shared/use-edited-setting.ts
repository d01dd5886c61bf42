import { useEffect, useRef, type RefObject } from "react";
import type { EditedSetting } from "../../session/shell";
import { useApp, useShell } from "./app-context";

/** Moves the focus to the field of a setting, in the returned element, when the shell asks for it. */
export function useEditedSetting(setting: EditedSetting): RefObject<HTMLDivElement | null> {
  const { shell } = useApp();
  const isEdited = useShell((state) => state.editedSetting === setting);
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!isEdited) return;
    const settings = box.current?.closest("details");
    if (settings) settings.open = true;
    const number = box.current?.querySelector<HTMLInputElement>("input:not([type=radio])");
    // Without a number, its place in the panel gets the focus: the choice that decides whether there is one.
    const field = number ?? box.current?.querySelector<HTMLInputElement>("input:checked");
    field?.focus();
    number?.select();
    shell.setState({ editedSetting: null });
  }, [shell, isEdited]);
  return box;
}
