import type { Project } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { commit, redo, startHistory, undo, type Edit, type History } from "./history";

/** What undo and redo travel through: opening another file is an edit like any other. */
export interface DocumentContent {
  readonly project: Project;
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

/** A hash of 64 bits, fed with whole numbers. */
class Hash {
  #a: number = seeds[0];
  #b: number = seeds[1];

  add(value: number): void {
    this.#a = Math.imul(this.#a ^ value, factors[0]);
    this.#b = Math.imul(this.#b ^ value, factors[1]);
    this.#a ^= this.#b >>> 15;
    this.#b ^= this.#a >>> 13;
  }

  /** As hexadecimal digits. */
  get text(): string {
    return [this.#a, this.#b].map((half) => (half >>> 0).toString(16).padStart(8, "0")).join("");
  }
}

const scratch = new DataView(new ArrayBuffer(8));

function addReal(hash: Hash, value: number): void {
  scratch.setFloat64(0, value);
  hash.add(scratch.getUint32(0));
  hash.add(scratch.getUint32(4));
}

/** Of a text; equal for different texts once in 10^19. */
function hashText(text: string): string {
  const hash = new Hash();
  for (let i = 0; i < text.length; ++i) hash.add(text.charCodeAt(i));
  return hash.text;
}

/** The lists that may be long are hashed number by number, without a text in between. */
function hashNodes(nodes: Project["background"]["nodes"]): string {
  const hash = new Hash();
  for (const { id, at, size, stretching, direction } of nodes) {
    hash.add(id);
    hash.add((stretching === undefined ? 0 : 1) + (direction === undefined ? 0 : 2));
    for (const value of at) addReal(hash, value);
    addReal(hash, size);
    if (stretching !== undefined) addReal(hash, stretching);
    for (const value of direction ?? []) addReal(hash, value);
  }
  return hash.text;
}

function hashTetrahedra(tetrahedra: Project["background"]["tetrahedra"]): string {
  const hash = new Hash();
  for (const corners of tetrahedra) for (const id of corners) hash.add(id);
  return hash.text;
}

function keyOf<Part extends object>(part: Part, compute: (part: Part) => string): string {
  let key = partKeys.get(part);
  if (key === undefined) {
    key = compute(part);
    partKeys.set(part, key);
  }
  return key;
}

const hashJson = (part: object): string => hashText(JSON.stringify(part));

/**
 * Equal for projects of equal content, whatever their identity. Each list is looked at once only, so
 * that moving a point costs nothing for a large background grid.
 */
export function contentKey(project: Project): string {
  let key = keys.get(project);
  if (key === undefined) {
    const { points, lines, patches, background, ...head } = project;
    const { nodes, tetrahedra, sources = [], overhang = 0 } = background;
    const parts = [
      ...[points, lines, patches, sources].map((part) => keyOf(part, hashJson)),
      keyOf(nodes, hashNodes),
      keyOf(tetrahedra, hashTetrahedra),
    ];
    key = [JSON.stringify(head), overhang, ...parts].join(" ");
    keys.set(project, key);
  }
  return key;
}

/** The undoable document: the project, its history, and whether a file holds it. */
export class DocumentStore {
  readonly state: StoreApi<DocumentState>;
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
