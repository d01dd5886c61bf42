import { openDB, type DBSchema, type IDBPDatabase } from "idb";
import { parseProject, type Project } from "tetrafront";
import { createStore, type StoreApi } from "zustand/vanilla";
import type { DocumentStore } from "./store";

interface Saved {
  /** The project's JSON; earlier versions kept the project itself, which took its time. */
  readonly text?: string;
  readonly project?: Project;
  readonly savedKey: string;
  readonly uniformSize?: number | null;
  /** Milliseconds since 1970. */
  readonly at: number;
}

export interface Kept {
  readonly project: Project;
  readonly savedKey: string;
  readonly uniformSize: number | null;
}

interface AutosaveSchema extends DBSchema {
  versions: { key: number; value: Saved };
}

/** The browser keeps this many states of the document, the newest last. */
const ringLength = 5;
const idleMs = 1000;

/**
 * Writes the document to IndexedDB a second after the last change, and at once when the page is being
 * left. A browser without storage (private mode) loses only this safety net.
 */
export class Autosave {
  readonly #documents: DocumentStore;
  readonly #database: Promise<IDBPDatabase<AutosaveSchema> | null>;
  #background: { readonly of: Project["background"]; readonly text: string } | null = null;
  #timer: ReturnType<typeof setTimeout> | null = null;
  #writing: Promise<void> = Promise.resolve();
  /** `pending`: there is a change that no storage holds yet; leaving the page deserves a warning. */
  readonly state: StoreApi<{ readonly pending: boolean }> = createStore<{ readonly pending: boolean }>(
    () => ({ pending: false }),
  );

  constructor(documents: DocumentStore, databaseName = "tetrafront") {
    this.#documents = documents;
    this.#database = openDB<AutosaveSchema>(databaseName, 1, {
      upgrade: (database) => {
        database.createObjectStore("versions", { autoIncrement: true });
      },
    }).catch(() => null);
  }

  /** The newest state kept, or null; a state that no longer reads is passed over. */
  async load(): Promise<Kept | null> {
    const database = await this.#database;
    if (!database) return null;
    const versions = await database.getAll("versions");
    for (const version of versions.reverse()) {
      const { text, project, savedKey, uniformSize = null } = version;
      const read = parseProject(text === undefined ? project : JSON.parse(text));
      if (read.success) return { project: read.value, savedKey, uniformSize };
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

  /** Writes now what is not yet written. */
  flush(): Promise<void> {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    if (this.state.getState().pending) this.#writing = this.#writing.then(() => this.#write());
    return this.#writing;
  }

  /** The project's JSON. The background, which may be large and seldom changes, is not written afresh. */
  #textOf({ background, ...rest }: Project): string {
    if (this.#background?.of !== background) {
      this.#background = { of: background, text: JSON.stringify(background) };
    }
    return `${JSON.stringify(rest).slice(0, -1)},"background":${this.#background.text}}`;
  }

  async #write(): Promise<void> {
    const database = await this.#database;
    if (!database) return;
    const state = this.#documents.state.getState();
    const { project, uniformSize } = state.history.present;
    const { savedKey } = state;
    const text = this.#textOf(project);
    try {
      const transaction = database.transaction("versions", "readwrite");
      await transaction.store.add({ text, savedKey, uniformSize, at: Date.now() });
      const keys = await transaction.store.getAllKeys();
      await Promise.all(keys.slice(0, -ringLength).map((key) => transaction.store.delete(key)));
      await transaction.done;
      this.state.setState({ pending: this.#documents.state.getState() !== state });
    } catch {
      this.state.setState({ pending: true });
    }
  }
}
