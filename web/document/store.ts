import type { Project } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { commit, redo, startHistory, undo, type Edit, type History } from "./history";

/** What undo and redo travel through: opening another file is an edit like any other. */
export interface DocumentContent {
  readonly project: Project;
  /** One element size everywhere instead of the background grid's; null: the grid decides. */
  readonly uniformSize: number | null;
}

export type ProjectEdit = Edit<DocumentContent>;

export interface DocumentState {
  readonly history: History<DocumentContent>;
  /** Content key of the project as last opened or saved to a file. */
  readonly savedKey: string;
}

const keys = new WeakMap<Project, string>();
const partKeys = new WeakMap<object, string>();

/** Odd constants of about 32 random bits, and the two states of the hash to begin with. */
const factors = [0x9e3779b1, 0x85ebca77] as const;
const seeds = [0x243f6a88, 0x13198a2e] as const;

/** 64 bits of a text as hexadecimal digits; equal for different texts once in 10^19. */
function hashText(text: string): string {
  let [a, b]: readonly [number, number] = seeds;
  for (let i = 0; i < text.length; ++i) {
    const code = text.charCodeAt(i);
    a = Math.imul(a ^ code, factors[0]);
    b = Math.imul(b ^ code, factors[1]);
    a ^= b >>> 15;
    b ^= a >>> 13;
  }
  return [a, b].map((half) => (half >>> 0).toString(16).padStart(8, "0")).join("");
}

function partKey(part: object): string {
  let key = partKeys.get(part);
  if (key === undefined) {
    key = hashText(JSON.stringify(part));
    partKeys.set(part, key);
  }
  return key;
}

/**
 * Equal for projects of equal content, whatever their identity. Each list is looked at once only, so
 * that moving a point costs nothing for a large background grid.
 */
export function contentKey(project: Project): string {
  let key = keys.get(project);
  if (key === undefined) {
    const { points, lines, patches, background, ...head } = project;
    const { nodes, tetrahedra, sources = [], overhang = 0 } = background;
    const parts = [points, lines, patches, nodes, tetrahedra, sources].map(partKey);
    key = [JSON.stringify(head), overhang, ...parts].join(" ");
    keys.set(project, key);
  }
  return key;
}

/** Equal for documents whose meshes are equal. */
export function meshKey({ project, uniformSize }: DocumentContent): string {
  return `${uniformSize ?? "grid"} ${contentKey(project)}`;
}

/** The undoable document: the project, its history, and whether a file holds it. */
export class DocumentStore {
  readonly state: StoreApi<DocumentState>;
  readonly #now: () => number;

  constructor(project: Project, now: () => number = () => performance.now()) {
    this.#now = now;
    this.state = createStore<DocumentState>(() => ({
      history: startHistory<DocumentContent>({ project, uniformSize: null }),
      savedKey: contentKey(project),
    }));
  }

  get content(): DocumentContent {
    return this.state.getState().history.present;
  }

  get project(): Project {
    return this.content.project;
  }

  edit(edit: ProjectEdit): void {
    this.#set(commit(this.state.getState().history, edit, this.#now()));
  }

  undo(): void {
    this.#set(undo(this.state.getState().history));
  }

  redo(): void {
    this.#set(redo(this.state.getState().history));
  }

  /** Replaces the document, undoably, so that nothing unsaved is lost by opening something else. */
  open(project: Project, label: string): void {
    this.edit({
      label,
      change: (draft) => {
        draft.project = project as typeof draft.project;
        draft.uniformSize = null;
      },
    });
    this.markSaved();
  }

  /** Starts afresh with a project that was kept over a reload; no history, perhaps unsaved. */
  restore(project: Project, savedKey: string, uniformSize: number | null = null): void {
    this.state.setState({ history: startHistory<DocumentContent>({ project, uniformSize }), savedKey });
  }

  markSaved(): void {
    this.state.setState({ savedKey: contentKey(this.project) });
  }

  /** Calls back whenever the project, or what it is meshed with, is another. Returns the way to stop. */
  onProject(listener: (project: Project) => void): () => void {
    return this.state.subscribe((state, before) => {
      const { present } = state.history;
      if (present !== before.history.present) listener(present.project);
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
