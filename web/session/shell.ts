import type { LengthUnit } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";

/** Colours of the page, in the order of their commands. */
export const schemes = ["light", "dark", "auto"] as const;
export type Scheme = (typeof schemes)[number];

export type DialogName =
  | "help"
  | "new-point"
  | "new-node"
  | "cover"
  | "propose"
  | "recent"
  | "templates"
  | "export"
  | "share"
  | "picture"
  | "adapt";

/** A message that does not interrupt the work and needs no answer. */
export interface Notice {
  /** A notice replaces an earlier one with the same key. */
  readonly key:
    | "document-left"
    | "autosave-failed"
    | "file-notes"
    | "improvement"
    | "repair"
    | "prepared"
    | "deleted"
    | "note"
    | "shared"
    | "animation"
    | "address"
    | "update"
    | "offline"
    | "worker";
  readonly tone: "information" | "warning";
  readonly text: string;
  readonly action: { readonly label: string; readonly run: () => void };
}

/** Which tabs, drawers and dialogs are open. Undo does not affect it, and a reload resets it. */
export interface ShellState {
  /** On wide screens, the lens is there while a front is shown. */
  readonly leftTab: "model" | "examples" | "lens";
  readonly rightTab: "inspector" | "quality" | "display" | "solution";
  readonly bottomTab: "log" | "problems" | "patches" | "front" | "history";
  /** On small screens the panels are drawers. */
  readonly drawer: "left" | "right" | "bottom" | null;
  readonly dialog: DialogName | null;
  /** Whether the start page is shown beside the model. */
  readonly startPage: boolean;
  /** The length unit that the user has chosen for a project with numbers, until the use of the numbers is decided. */
  readonly chosenUnit: LengthUnit | null;
  /** Field of the selected entity that gets the focus as soon as the inspector shows it; null if none. */
  readonly editing: EditedField | null;
  /** Setting of the project whose field gets the focus as soon as the inspector shows it; null if none. */
  readonly editedSetting: EditedSetting | null;
  /** Colours of the page: light, dark, or as the system has them. */
  readonly scheme: Scheme;
  /** Whether the page has large type for an audience. */
  readonly isPresenting: boolean;
  /** Whether the pointer is followed by a red dot. */
  readonly hasLaser: boolean;
  /** A failure that the user must read before continuing. */
  readonly message: { readonly title: string; readonly lines: readonly string[] } | null;
  readonly notices: readonly Notice[];
  /** The surface file that is being read. */
  readonly reading: { readonly fileName: string; readonly abort: AbortController } | null;
}

/** The name of an entity, or the first of its other fields. */
export type EditedField = "name" | "values";

/** A setting whose field the focus can be moved to. */
export type EditedSetting = "uniform-size" | "elements" | "gradation" | "units";

export type Shell = StoreApi<ShellState>;

export function createShell(): Shell {
  return createStore<ShellState>(() => ({
    leftTab: "model",
    rightTab: "inspector",
    bottomTab: "log",
    drawer: null,
    dialog: null,
    startPage: false,
    chosenUnit: null,
    editing: null,
    editedSetting: null,
    scheme: "auto",
    isPresenting: false,
    hasLaser: false,
    message: null,
    notices: [],
    reading: null,
  }));
}

export function showNotice(shell: Shell, notice: Notice): void {
  shell.setState(({ notices }) => ({
    notices: [...notices.filter(({ key }) => key !== notice.key), notice],
  }));
}

export function hideNotice(shell: Shell, hidden: Notice["key"]): void {
  hideNotices(shell, [hidden]);
}

/** Notices about a mesh, or about what becomes of an opened file in the next one: they give way to a run. */
const ofMesh: readonly Notice["key"][] = ["file-notes", "improvement", "prepared"];
/** Notices about the open document, which give way to another one. */
const ofDocument: readonly Notice["key"][] = [...ofMesh, "deleted", "note"];

export const hideMeshNotices = (shell: Shell): void => hideNotices(shell, ofMesh);
export const hideDocumentNotices = (shell: Shell): void => hideNotices(shell, ofDocument);

function hideNotices(shell: Shell, hidden: readonly Notice["key"][]): void {
  shell.setState(({ notices }) => ({ notices: notices.filter(({ key }) => !hidden.includes(key)) }));
}
