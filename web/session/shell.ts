import { createStore, type StoreApi } from "zustand/vanilla";

export type DialogName = "help" | "new-point" | "new-node" | "cover" | "propose" | "recent";

/** A message beside the work, which waits for no answer. */
export interface Notice {
  /** A notice takes the place of an earlier one with the same key. */
  readonly key: "document-left" | "autosave-failed";
  readonly tone: "information" | "warning";
  readonly text: string;
  readonly action: { readonly label: string; readonly run: () => void };
}

/** Which tabs, drawers and dialogs are open; never undone, not kept over a reload. */
export interface ShellState {
  readonly leftTab: "model" | "examples";
  readonly rightTab: "inspector" | "quality" | "display";
  readonly bottomTab: "log" | "problems" | "patches";
  /** On small screens the panels are drawers. */
  readonly drawer: "left" | "right" | "bottom" | null;
  readonly dialog: DialogName | null;
  /** A failure that the user must read before going on. */
  readonly message: { readonly title: string; readonly lines: readonly string[] } | null;
  readonly notices: readonly Notice[];
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
    notices: [],
  }));
}

export function showNotice(shell: Shell, notice: Notice): void {
  shell.setState(({ notices }) => ({
    notices: [...notices.filter(({ key }) => key !== notice.key), notice],
  }));
}

export function hideNotice(shell: Shell, hidden: Notice["key"]): void {
  shell.setState(({ notices }) => ({ notices: notices.filter(({ key }) => key !== hidden) }));
}
