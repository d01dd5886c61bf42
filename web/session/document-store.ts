import { liveNotes, type Project } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import { documentKey, shownMeshKey } from "../document/content-keys";
import { changedContent, type Change, type DocumentContent, type ProjectEdit } from "../document/edit";
import { bodiesOf } from "../document/entities";
import { agreement } from "../document/expression-edits";
import { paintedSizes } from "../document/painted-sizes";
import { amend, commit, goBy, redo, startHistory, undo, type History } from "./history";
import { untilState } from "./until-state";

/** The file that Save writes to. */
export interface ProjectFile {
  readonly handle: FileSystemFileHandle;
  /** Time of the file's last change that this document has read or written; milliseconds since 1970. */
  readonly lastModified: number;
}

/** A document with its undo steps and its file: everything that belongs to this document alone. */
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
  /** The content when the current gesture began; null without a gesture. */
  readonly gestureStart: DocumentContent | null;
  /** Aborted as soon as another document is shown, or this one again. */
  readonly left: AbortSignal;
}

/** A continuous change, for example a drag: one undo step, however often it is updated. */
export interface Gesture {
  /** Replaces the gesture's change so far by a change of the project as it was at the beginning. */
  readonly update: (change: Change) => void;
  /** Ends the gesture as one undo step, or as none if nothing has changed. */
  readonly commit: () => void;
  /** Ends the gesture and restores the project as it was at the beginning. */
  readonly cancel: () => void;
}

/** Makes a document from a project that is not stored yet, or only in a file. */
export function newDocument(
  project: Project,
  file: ProjectFile | null = null,
  meshVersion?: string,
): OpenDocument {
  return {
    id: newDocumentId(),
    history: startHistory<DocumentContent>({ project, ...(meshVersion !== undefined && { meshVersion }) }),
    savedKey: documentKey(project),
    file,
  };
}

/** Random, so that two tabs, or two visits of the page, never choose the same id. */
export function newDocumentId(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(12));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/**
 * Returns the content after a change. The change also removes what groups and expressions note about entities that are gone,
 * makes numbers and their expressions agree, and keeps painted sizes on their bodies.
 */
function contentAfter(before: DocumentContent, change: Change): DocumentContent {
  const after = changedContent(before, change);
  if (after.project === before.project) return after;
  const notes = isSameShape(before.project, after.project) ? {} : liveNotes(after.project);
  const agreed = agreeing(before, { ...after, project: { ...after.project, ...notes } });
  const painted = paintedSizes(before.project, agreed.project);
  const { project, ...rest } = painted ? agreeing(before, changedContent(agreed, painted)) : agreed;
  const { expressions = [], ...bare } = project;
  // An empty list of expressions says nothing.
  return { ...rest, project: expressions.length > 0 ? project : bare };
}

/** Returns whether two values of plain data have the same ids, fields and lengths, so that the same notes apply to them. */
function isSameShape(a: unknown, b: unknown): boolean {
  if (a === b || typeof a !== "object" || typeof b !== "object" || a === null || b === null)
    return typeof a === typeof b;
  if (Array.isArray(a) && Array.isArray(b))
    return a.length === b.length && a.every((item, i) => item === b[i] || isSameShape(item, b[i]));
  const [fields, others] = [a, b] as [Readonly<Record<string, unknown>>, Readonly<Record<string, unknown>>];
  const keys = Object.keys(fields);
  return (
    fields["id"] === others["id"] &&
    keys.length === Object.keys(others).length &&
    keys.every((key) => key in others && isSameShape(fields[key], others[key]))
  );
}

function agreeing({ project }: DocumentContent, after: DocumentContent): DocumentContent {
  const change = agreement(project, after.project);
  return change ? changedContent(after, change) : after;
}

/** The open document: its project, its undo steps, and whether a file contains it. */
export class DocumentStore {
  readonly state: StoreApi<DocumentState>;
  /** True while a key is held down: all repetitions of the key are one undo step. */
  held = false;
  readonly #now: () => number;
  /** The current gesture. Calls of an ended gesture have no effect. */
  #gesture: Gesture | null = null;
  #left = new AbortController();
  readonly #leaving = new Set<() => void>();

  constructor(project: Project, now: () => number = () => performance.now()) {
    this.#now = now;
    this.state = createStore<DocumentState>(() => ({
      ...newDocument(project),
      gestureStart: null,
      left: this.#left.signal,
    }));
  }

  /** The project as it is shown, also during a gesture. */
  get project(): Project {
    return this.state.getState().history.present.project;
  }

  /** Aborted as soon as another document is shown. What is made for the present one must not be shown then. */
  get left(): AbortSignal {
    return this.#left.signal;
  }

  /** Calls back when another document is about to be shown, to forget what belongs to the one before. */
  onLeave(listener: () => void): void {
    this.#leaving.add(listener);
  }

  /** Shows a mesh of the project, as a step of undo: null for the one that a run makes. */
  setMeshVersion(label: string, meshVersion: string | null): void {
    this.edit({ label, change: (draft) => void (draft.meshVersion = meshVersion) });
  }

  /** Applies an edit, after committing the current gesture. */
  edit(edit: ProjectEdit): void {
    this.#gesture?.commit();
    const { history } = this.state.getState();
    this.#set(commit(history, edit, contentAfter(history.present, edit), this.#now(), this.held));
  }

  /**
   * Makes a change part of the last step of undo, because it only computes what follows from it. Does nothing during a
   * gesture.
   */
  amend(change: Change): void {
    if (this.#gesture) return;
    const { history } = this.state.getState();
    this.#set(amend(history, contentAfter(history.present, change)));
  }

  /** Resolves when no gesture is under way: work that ends during a drag must not cut it short with its edit. Rejects if it is aborted. */
  async afterGesture(signal?: AbortSignal): Promise<void> {
    while (this.#gesture) {
      const { gestureStart: start } = this.state.getState();
      await untilState(this.state, ({ gestureStart }) => gestureStart !== start, signal);
    }
  }

  /** Shows the mesh that a run makes of the project, without a step of undo. Does nothing during a gesture. */
  forgetMeshVersion(): void {
    if (this.#gesture) return;
    const { history } = this.state.getState();
    this.#set({ ...history, present: { ...history.present, meshVersion: null } });
  }

  /** Begins a gesture, after committing the current one. */
  begin(label: string): Gesture {
    this.#gesture?.commit();
    const { history } = this.state.getState();
    const start = history.present;
    let content = start;
    const end = (ended: History<DocumentContent>): void => {
      if (this.#gesture !== gesture) return;
      this.#gesture = null;
      this.state.setState({ history: ended, gestureStart: null });
    };
    const gesture: Gesture = {
      update: (change) => {
        if (this.#gesture !== gesture) return;
        content = contentAfter(start, change);
        this.state.setState({ history: { ...history, present: content } });
      },
      commit: () => end(commit(history, { label }, content, this.#now())),
      cancel: () => end(history),
    };
    this.#gesture = gesture;
    this.state.setState({ gestureStart: start });
    return gesture;
  }

  /** Cancels the current gesture; without one, goes one step back. */
  undo(): void {
    if (this.#gesture) this.#gesture.cancel();
    else this.#set(undo(this.state.getState().history));
  }

  /** Goes one step forward; does nothing during a gesture. */
  redo(): void {
    if (!this.#gesture) this.#set(redo(this.state.getState().history));
  }

  /** Goes to the state after a number of the steps that can be undone or redone; cancels the current gesture. */
  jumpTo(steps: number): void {
    this.#gesture?.cancel();
    const { history } = this.state.getState();
    this.#set(goBy(history, steps - history.past.length));
  }

  /** Cancels the current gesture, shows another document, and returns the previous one. */
  show({ id, history, savedKey, file }: OpenDocument): DocumentState {
    this.#gesture?.cancel();
    const before = this.state.getState();
    this.#left.abort();
    this.#left = new AbortController();
    for (const forget of this.#leaving) forget();
    this.state.setState({ id, history, savedKey, file, left: this.left });
    return before;
  }

  /**
   * Records that a file contains the given project of the document with this id. The document may have
   * changed meanwhile.
   */
  markSaved(id: string, project: Project, file: ProjectFile | null): void {
    if (this.state.getState().id !== id) return;
    this.state.setState({ savedKey: documentKey(project), file });
  }

  /** Calls back whenever the project changes, and for every document that is shown. Returns a function that stops this. */
  onProject(listener: (project: Project) => void): () => void {
    return this.state.subscribe((state, before) => {
      const { project } = state.history.present;
      if (state.left !== before.left || project !== before.history.present.project) listener(project);
    });
  }

  /** As `onProject` for the content, but not during a gesture. Returns a function that stops this. */
  onSettled(listener: (content: DocumentContent) => void): () => void {
    return this.state.subscribe((state, before) => {
      const content = settledContent(state);
      const last = settledContent(before);
      const isChanged = content.project !== last.project || content.meshVersion !== last.meshVersion;
      if (isChanged || state.left !== before.left) listener(content);
    });
  }

  #set(history: History<DocumentContent>): void {
    if (history !== this.state.getState().history) this.state.setState({ history });
  }
}

/** The content without the current gesture. Keys are computed only for this content, so never during a drag. */
export function settledContent({ gestureStart, history }: DocumentState): DocumentContent {
  return gestureStart ?? history.present;
}

/** The project without the current gesture. */
export const settledProject = (state: DocumentState): Project => settledContent(state).project;

/** Returns whether the project differs from the content of the file opened or saved last. */
export function hasUnsavedChanges(state: DocumentState): boolean {
  const project = settledProject(state);
  return project !== state.history.present.project || documentKey(project) !== state.savedKey;
}

/** Returns whether the document is as it was opened: without undo or redo steps, and equal to its file. */
export function isUntouched(state: DocumentState): boolean {
  const { past, future } = state.history;
  return past.length === 0 && future.length === 0 && !hasUnsavedChanges(state);
}

/** Returns whether lists show the document: it is in a file, was made of one, as all bodies are, or was changed. */
export function isListed(state: DocumentState): boolean {
  return state.file !== null || bodiesOf(state.history.present.project).length > 0 || !isUntouched(state);
}

/**
 * Returns whether a file contains the project; an unchanged example or new project needs no file. Projects never contain a
 * mesh that was opened or improved.
 */
export function savedState(state: DocumentState): "saved" | "unsaved" | "unchanged" | "without-mesh" {
  if (hasUnsavedChanges(state)) return "unsaved";
  const content = settledContent(state);
  if (content.meshVersion && shownMeshKey(content) === content.meshVersion) return "without-mesh";
  return state.file === null && isUntouched(state) ? "unchanged" : "saved";
}
