import type { App } from "../app/app";

export type MenuName = "file" | "edit" | "create" | "view" | "mesh" | "help";

/** One thing the user can do: menu, palette, hotkeys and help all read this table. */
export interface Command {
  readonly id: string;
  readonly menu: MenuName;
  /** Items of a menu with different sections are set apart. */
  readonly section: number;
  readonly label: (app: App) => string;
  /** In Mantine's notation, e.g. "mod+Z". The first is shown. */
  readonly keys: readonly string[];
  /** Hotkey works even while a text field has the focus. */
  readonly inFields: boolean;
  readonly enabled: (app: App) => boolean;
  /** For commands that switch something: is it on? */
  readonly checked: ((app: App) => boolean) | null;
  readonly run: (app: App) => void;
}

interface Extra {
  readonly keys?: readonly string[];
  readonly inFields?: boolean;
  readonly enabled?: (app: App) => boolean;
  readonly checked?: (app: App) => boolean;
}

type Label = string | ((app: App) => string);

export const define =
  (menu: MenuName, section: number) =>
  (id: string, label: Label, run: (app: App) => void, extra: Extra = {}): Command => ({
    id,
    menu,
    section,
    label: typeof label === "string" ? () => label : label,
    keys: extra.keys ?? [],
    inFields: extra.inFields ?? false,
    enabled: extra.enabled ?? (() => true),
    checked: extra.checked ?? null,
    run,
  });
