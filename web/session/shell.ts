import { createStore, type StoreApi } from "zustand/vanilla";

export type DialogName = "help" | "new-point" | "new-node" | "cover" | "propose";

/** Which tabs, drawers and dialogs are open; never undone, not kept over a reload. */
export interface ShellState {
  readonly leftTab: "model" | "examples";
  readonly rightTab: "inspector" | "quality" | "display";
  readonly bottomTab: "log" | "problems" | "patches";
  /** On small screens the panels are drawers. */
  readonly drawer: "left" | "right" | "bottom" | null;
  readonly dialog: DialogName | null;
  /** Something the user must know and nothing else on the screen says. */
  readonly message: { readonly title: string; readonly lines: readonly string[] } | null;
}

export type Shell = StoreApi<ShellState>;

export function createShell(): Shell {
  return createStore<ShellState>(() => ({
    leftTab: "model",
    rightTab: "inspector",
    bottomTab: "log",
    drawer: null,
    dialog: null,
    message: null,
  }));
}
