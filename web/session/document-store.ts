import type { Project } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { documentKey } from "../document/content-keys";
import type { Change, DocumentContent, ProjectEdit } from "../document/edit";
import { addStep, commit, redo, startHistory, stepFrom, undo, type History, type Step } from "./history";

/** The file that Save writes to. */
export interface ProjectFile {
  readonly handle: FileSystemFileHandle;
  /** Time of the file's last change that this document has read or written; milliseconds since 1970. */
  readonly lastModified: number;
}

/** A document with its steps of undo and its file: everything that belongs to it and to no other. */
export interface OpenDocument {
  /** Identifies the document in the browser's storage. */
  readonly id: string;
  readonly history: History<DocumentContent>;
  /** Key of the project as last opened from or saved to a file. */
  readonly savedKey: string;
  /** Null until the user has chosen a file, and in browsers that do not reveal it. */
  readonly file: ProjectFile | null;
}

export interface DocumentState extends OpenDocument {
  /** The content when the gesture under way began; null without a gesture. */
  readonly gestureStart: DocumentContent | null;
}

/** A continuous change, for example a drag: one step of undo however often it is updated. */
export interface Gesture {
  /** Replaces what the gesture has done so far by a change of the project as it was at the beginning. */
  readonly update: (change: Change<DocumentContent>) => void;
  /** Ends the gesture as one step of undo, or as none if nothing has changed. */
  readonly commit: () => void;
  /** Ends the gesture and restores the project as it was at the beginning. */
  readonly cancel: () => void;
}

/** Makes a document of a project that is stored nowhere yet, or in a file only. */
export function newDocument(project: Project, file: ProjectFile | null = null): OpenDocument {
  return {
    id: newDocumentId(),
    history: startHistory<DocumentContent>({ project }),
    savedKey: documentKey(project),
    file,
  };
}

/** Random: two tabs never choose the same id. */
export function newDocumentId(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(12));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** The open document: its project, its steps of undo, and whether a file holds it. */
export class DocumentStore {
  readonly state: StoreApi<DocumentState>;
  /** True while a key is held down, so that all it repeats is one step of undo. */
  held = false;
  readonly #now: () => number;
  /** The gesture under way. An ended gesture does nothing any more. */
  #gesture: Gesture | null = null;

  constructor(project: Project, now: () => number = () => performance.now()) {
    this.#now = now;
    this.state = createStore<DocumentState>(() => ({ ...newDocument(project), gestureStart: null }));
  }

  /** The project as it is shown, in the middle of a gesture too. */
  get project(): Project {
    return this.state.getState().history.present.project;
  }

  /** Applies an edit. A gesture under way is committed first. */
  edit(edit: ProjectEdit): void {
    this.#gesture?.commit();
    this.#set(commit(this.state.getState().history, edit, this.#now(), this.held));
  }

  /** Begins a gesture. A gesture under way is committed first. */
  begin(label: string): Gesture {
    this.#gesture?.commit();
    const { history } = this.state.getState();
    const start = history.present;
    let step: Step<DocumentContent> | null = null;
    const end = (ended: History<DocumentContent>): void => {
      if (this.#gesture !== gesture) return;
      this.#gesture = null;
      this.state.setState({ history: ended, gestureStart: null });
    };
    const gesture: Gesture = {
      update: (change) => {
        if (this.#gesture !== gesture) return;
        step = stepFrom(start, change);
        this.state.setState({ history: { ...history, present: step.present } });
      },
      commit: () => end(step ? addStep(history, label, step, this.#now()) : history),
      cancel: () => end(history),
    };
    this.#gesture = gesture;
    this.state.setState({ gestureStart: start });
    return gesture;
  }

  /** Cancels the gesture under way; without one, goes one step back. */
  undo(): void {
    if (this.#gesture) this.#gesture.cancel();
    else this.#set(undo(this.state.getState().history));
  }

  /** Goes one step forward; does nothing during a gesture. */
  redo(): void {
    if (!this.#gesture) this.#set(redo(this.state.getState().history));
  }

  /** Shows another document and returns the one before. A gesture under way is cancelled. */
  show({ id, history, savedKey, file }: OpenDocument): DocumentState {
    this.#gesture?.cancel();
    const before = this.state.getState();
    this.state.setState({ id, history, savedKey, file });
    return before;
  }

  /** Notes that a file holds the given project of the document with this id. It may have changed meanwhile. */
  markSaved(id: string, project: Project, file: ProjectFile | null): void {
    if (this.state.getState().id === id) this.state.setState({ savedKey: documentKey(project), file });
  }

  /** Calls back whenever the project changes. Returns a function that stops this. */
  onProject(listener: (project: Project) => void): () => void {
    return this.state.subscribe((state, before) => {
      const { project } = state.history.present;
      if (project !== before.history.present.project) listener(project);
    });
  }

  /** Calls back whenever the project changes, but not during a gesture. Returns a function that stops this. */
  onSettled(listener: (project: Project) => void): () => void {
    return this.state.subscribe((state, before) => {
      const project = settledProject(state);
      if (project !== settledProject(before)) listener(project);
    });
  }

  #set(history: History<DocumentContent>): void {
    if (history !== this.state.getState().history) this.state.setState({ history });
  }
}

/** The project without the gesture under way. Keys are computed for it alone, never during a drag. */
export function settledProject({ gestureStart, history }: DocumentState): Project {
  return (gestureStart ?? history.present).project;
}

/** Does the project differ from what the last opened or saved file holds? */
export function hasUnsavedChanges(state: DocumentState): boolean {
  const project = settledProject(state);
  return project !== state.history.present.project || documentKey(project) !== state.savedKey;
}

/** Is the document as it was opened: without a step of undo or redo, and as its file has it? */
export function isUntouched(state: DocumentState): boolean {
  const { past, future } = state.history;
  return past.length === 0 && future.length === 0 && !hasUnsavedChanges(state);
}

/** Returns whether a file has the project; an example or a new project that was not changed needs none. */
export function savedState(state: DocumentState): "saved" | "unsaved" | "unchanged" {
  if (hasUnsavedChanges(state)) return "unsaved";
  return state.file === null && isUntouched(state) ? "unchanged" : "saved";
}
