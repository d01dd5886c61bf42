import type { Project } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { contentKey } from "../document/content-key";
import type { DocumentContent, ProjectEdit } from "../document/edit";
import { commit, redo, startHistory, undo, type History } from "./history";

export interface DocumentState {
  readonly history: History<DocumentContent>;
  /** Content key of the project as last opened or saved to a file. */
  readonly savedKey: string;
}

/** The undoable document: the project, its history, and whether a file holds it. */
export class DocumentStore {
  readonly state: StoreApi<DocumentState>;
  /** True while a key is held down, so that what it does again and again is one step of undo. */
  held = false;
  readonly #now: () => number;

  constructor(project: Project, now: () => number = () => performance.now()) {
    this.#now = now;
    this.state = createStore<DocumentState>(() => ({
      history: startHistory<DocumentContent>({ project }),
      savedKey: contentKey(project),
    }));
  }

  get project(): Project {
    return this.state.getState().history.present.project;
  }

  edit(edit: ProjectEdit): void {
    this.#set(commit(this.state.getState().history, edit, this.#now(), this.held));
  }

  undo(): void {
    this.#set(undo(this.state.getState().history));
  }

  redo(): void {
    this.#set(redo(this.state.getState().history));
  }

  /** Replaces the document, undoably, so that nothing unsaved is lost by opening something else. */
  open(project: Project, label: string): void {
    this.edit({ label, replace: [[["project"], project]] });
    this.markSaved();
  }

  /** Starts afresh with a project that was kept over a reload; no history, perhaps unsaved. */
  restore(project: Project, savedKey: string): void {
    this.state.setState({ history: startHistory<DocumentContent>({ project }), savedKey });
  }

  markSaved(): void {
    this.state.setState({ savedKey: contentKey(this.project) });
  }

  /** Calls back whenever the project is another. Returns the way to stop. */
  onProject(listener: (project: Project) => void): () => void {
    return this.state.subscribe((state, before) => {
      const { project } = state.history.present;
      if (project !== before.history.present.project) listener(project);
    });
  }

  #set(history: History<DocumentContent>): void {
    if (history !== this.state.getState().history) this.state.setState({ history });
  }
}

/** Does the project differ from what the last opened or saved file holds? */
export function hasUnsavedChanges(state: DocumentState): boolean {
  return contentKey(state.history.present.project) !== state.savedKey;
}
