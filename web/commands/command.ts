import type { App } from "../app/app";
import { synonyms } from "../strings";

export type MenuName = "file" | "edit" | "create" | "view" | "mesh" | "help";

/** An action of the user. Menus, palette, hotkeys and help all come from these records. */
export interface Command {
  readonly id: string;
  readonly menu: MenuName;
  /** A menu draws a divider between different sections. */
  readonly section: number;
  readonly label: (app: App) => string;
  /** Other words that find it in the palette. */
  readonly words: string;
  /** In Mantine's notation, e.g. "mod+Z". The first is shown. */
  readonly keys: readonly string[];
  /** Do the keys work while a text field has the focus? */
  readonly inFields: boolean;
  readonly enabled: (app: App) => boolean;
  /** What a disabled command needs, shown in the palette; null: the palette hides it while it is disabled. */
  readonly needs: (app: App) => string | null;
  /** For commands that toggle something: is it on? Else null. */
  readonly checked: ((app: App) => boolean) | null;
  /** Whether a menu lists it; others are only found in the palette. */
  readonly inMenu: boolean;
  readonly run: (app: App) => void;
}

export interface Extra {
  readonly words?: string;
  readonly keys?: readonly string[];
  readonly inFields?: boolean;
  readonly enabled?: (app: App) => boolean;
  readonly needs?: string | ((app: App) => string | null);
  readonly checked?: (app: App) => boolean;
  readonly inMenu?: boolean;
}

type Label = string | ((app: App) => string);

export const define =
  (menu: MenuName, section: number) =>
  (
    id: string,
    label: Label,
    run: (app: App) => void,
    { needs = () => null, ...extra }: Extra = {},
  ): Command => ({
    id,
    menu,
    section,
    label: typeof label === "string" ? () => label : label,
    words: extra.words ?? synonyms[id] ?? "",
    keys: extra.keys ?? [],
    inFields: extra.inFields ?? false,
    enabled: extra.enabled ?? (() => true),
    needs: typeof needs === "function" ? needs : () => needs,
    checked: extra.checked ?? null,
    inMenu: extra.inMenu ?? true,
    run,
  });
