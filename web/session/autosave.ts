import { openDB, type DBSchema, type IDBPDatabase } from "idb";
import { parseProject, type Project } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import { manyTetrahedra } from "../document/engine-input";
import { documentGrid } from "../document/large-grid";
import { packedGrid, type PackedGrid } from "../document/packed-grid";
import type { DocumentState, DocumentStore } from "./document-store";

interface Saved {
  /** The project's JSON; earlier versions kept the project itself, which took its time. */
  readonly text?: string;
  /** Nodes and tetrahedra of the background grid, where they are many; the text then has none. */
  readonly grid?: PackedGrid;
  readonly project?: Project;
  readonly savedKey: string;
  /** Earlier versions kept the uniform size beside the project. */
  readonly uniformSize?: number | null;
  /** Milliseconds since 1970. */
  readonly at: number;
}

export interface Kept {
  readonly project: Project;
  readonly savedKey: string;
}

interface AutosaveSchema extends DBSchema {
  versions: { key: number; value: Saved };
}

type Database = IDBPDatabase<AutosaveSchema>;

/** The browser keeps this many states of the document of each tab, and of all tabs together. */
const ringLength = 5;
const allLength = 15;
const idleMs = 1000;

/** Keys are microseconds since 1970: the newest has the highest. */
const newKey = (after: number): number => Math.max(after + 1, Date.now() * 1000);

/** The keys of what this tab has written; they outlive a reload, but not the tab. */
class OwnKeys {
  static readonly #name = "tetrafront-versions";

  read(): number[] {
    try {
      const keys: unknown = JSON.parse(sessionStorage.getItem(OwnKeys.#name) ?? "[]");
      return Array.isArray(keys) ? keys.filter((key) => typeof key === "number") : [];
    } catch {
      return [];
    }
  }

  write(keys: readonly number[]): void {
    try {
      sessionStorage.setItem(OwnKeys.#name, JSON.stringify(keys));
    } catch {
      // Without it a reload shows what was written last, by whichever tab.
    }
  }
}

/**
 * Writes the document to IndexedDB a second after the last change, and at once when the page is being
 * left. Each tab comes back to its own document; a new one begins with the newest of all. A browser
 * without storage (private mode) loses only this safety net.
 */
export class Autosave {
  readonly #documents: DocumentStore;
  readonly #ownKeys = new OwnKeys();
  readonly #opening: Promise<Database | null>;
  #database: Database | null = null;
  /** What has been written, or is being written. */
  #kept: DocumentState | null = null;
  #timer: ReturnType<typeof setTimeout> | null = null;
  /** `pending`: there is a change that no storage holds yet; leaving the page deserves a warning. */
  readonly state: StoreApi<{ readonly pending: boolean }> = createStore<{ readonly pending: boolean }>(
    () => ({ pending: false }),
  );

  constructor(documents: DocumentStore, databaseName = "tetrafront") {
    this.#documents = documents;
    this.#opening = openDB<AutosaveSchema>(databaseName, 1, {
      upgrade: (database) => {
        database.createObjectStore("versions", { autoIncrement: true });
      },
    }).catch(() => null);
    void this.#opening.then((database) => (this.#database = database));
  }

  /** The newest state this tab has kept, else any tab, or null; one that no longer reads is passed over. */
  async load(): Promise<Kept | null> {
    const database = await this.#opening;
    if (!database) return null;
    const all = await database.getAllKeys("versions");
    for (const key of [...this.#ownKeys.read().reverse(), ...all.reverse()]) {
      const version = await database.get("versions", key);
      const project = version ? await readKept(version) : null;
      if (version && project) return { project, savedKey: version.savedKey };
    }
    return null;
  }

  /** Begins to follow the document. Returns the way to stop. */
  follow(): () => void {
    return this.#documents.state.subscribe(() => {
      this.state.setState({ pending: true });
      if (this.#timer !== null) clearTimeout(this.#timer);
      this.#timer = setTimeout(() => void this.flush(), idleMs);
    });
  }

  /**
   * Writes what is not yet written. The transaction is complete when this returns, though not its
   * answer: what is written while the page is being left is kept.
   */
  async flush(): Promise<void> {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    const database = this.#database;
    const state = this.#documents.state.getState();
    if (!database || !this.state.getState().pending || state === this.#kept) return;
    this.#kept = state;
    const { history, savedKey } = state;
    const own = this.#ownKeys.read();
    const key = newKey(own.at(-1) ?? 0);
    const written = this.#written(history.present.project);
    try {
      const transaction = database.transaction("versions", "readwrite");
      const added = transaction.store.add({ ...written, savedKey, at: Date.now() }, key);
      transaction.commit();
      this.#ownKeys.write([...own, key].slice(-ringLength));
      await Promise.all([added, transaction.done]);
      this.state.setState({ pending: this.#documents.state.getState() !== state });
      await prune(database, own.slice(0, 1 - ringLength));
    } catch {
      this.#kept = null;
    }
  }

  /** The project to be written. */
  #written({ background, ...rest }: Project): Pick<Saved, "text" | "grid"> {
    if (background.tetrahedra.length <= manyTetrahedra)
      return { text: JSON.stringify({ ...rest, background }) };
    const text = JSON.stringify({ ...rest, background: { ...background, nodes: [], tetrahedra: [] } });
    return { text, grid: packedGrid(background) };
  }
}

/** Takes away these states, and the oldest of all tabs. */
async function prune(database: Database, keys: readonly number[]): Promise<void> {
  const { store, done } = database.transaction("versions", "readwrite");
  const all = await store.getAllKeys();
  await Promise.all([...keys, ...all.slice(0, -allLength)].map((key) => store.delete(key)));
  await done;
}

async function readKept({ text, grid, project, uniformSize = null }: Saved): Promise<Project | null> {
  const read = parseProject(text === undefined ? project : JSON.parse(text));
  if (!read.success) return null;
  const { value } = read;
  if (uniformSize !== null) return { ...value, meshing: { size: uniformSize } };
  return grid ? { ...value, background: { ...value.background, ...(await documentGrid(grid)) } } : value;
}
