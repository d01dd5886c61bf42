import { openDB, type DBSchema, type IDBPDatabase, type OpenDBCallbacks } from "idb";
import { strings } from "../strings";
import type { DocumentWrite } from "./document-write";
import type { DocumentHead, DocumentSummary, KeptChange, KeptContent, KeptDocument } from "./kept-document";

/** Stores documents between visits, each under its id. */
export interface DocumentStorage {
  /** Returns the listed documents, the one changed last first. */
  readonly list: () => Promise<readonly DocumentSummary[]>;
  /** Returns the ids of documents that were never changed, which may be removed. */
  readonly listUntouched: () => Promise<readonly string[]>;
  /** Returns what is stored of all documents besides their contents, in no particular order. */
  readonly heads: () => Promise<readonly DocumentHead[]>;
  readonly read: (id: string) => Promise<KeptDocument | undefined>;
  /**
   * Writes what a document lacks. Rejects a change if the storage does not have the content that it continues. If the storage is open, the whole transaction is issued
   * before this returns, so that it completes even if the page is closed.
   */
  readonly write: (write: DocumentWrite) => Promise<void>;
  readonly remove: (ids: readonly string[]) => Promise<void>;
}

interface Schema extends DBSchema {
  documents: {
    key: string;
    /** Version 2 has stored the content here. */
    value: DocumentHead | (DocumentHead & KeptContent);
    /** Contains everything that a list needs, so that listing reads no document. */
    indexes: { recent: [listed: number, at: number, name: string] };
  };
  contents: { key: string; value: KeptContent; indexes: { stamp: string } };
  /** The key has the stamp, so that no change replaces one of another content. Version 3 has made keys without it. */
  changes: { key: [id: string, stamp: string, number: number]; value: KeptChange };
}

const stores = ["documents", "contents", "changes"] as const;
const databaseVersion = 4;

/** Arrays are greater than all numbers and texts. */
const changesOf = (id: string): IDBKeyRange => IDBKeyRange.bound([id], [id, []]);

/** The browser has no storage for the page, or refuses it. Its message is a sentence for the user. */
export class NoStorageError extends Error {
  constructor() {
    super(strings.notices.noStorage);
    this.name = "NoStorageError";
  }
}

/** Names of the errors with which browsers refuse a database: with blocked cookies, and in private windows. */
const refusals = ["SecurityError", "InvalidStateError", "NotAllowedError"];

const isSwitchedOff = (error: unknown): boolean => error instanceof Error && refusals.includes(error.name);

/** The user may have removed the data of the page, or, without locks, another tab may have replaced the content. */
function requireContent(count: number): void {
  if (count === 0) throw new Error("The document is no longer in the storage");
}

/** Documents in IndexedDB. If the database cannot be opened, the next call tries again. */
export class BrowserStorage implements DocumentStorage {
  readonly #name: string;
  #opening: Promise<IDBPDatabase<Schema>> | null = null;
  #database: IDBPDatabase<Schema> | null = null;

  constructor(name = "tetrafront") {
    this.#name = name;
  }

  async list(): Promise<readonly DocumentSummary[]> {
    const summaries: DocumentSummary[] = [];
    const index = (await this.#open()).transaction("documents").store.index("recent");
    for (
      let cursor = await index.openKeyCursor(IDBKeyRange.lowerBound([1]), "prev");
      cursor;
      cursor = await cursor.continue()
    ) {
      const [, at, name] = cursor.key;
      summaries.push({ id: cursor.primaryKey, at, name });
    }
    return summaries;
  }

  async listUntouched(): Promise<readonly string[]> {
    return (await this.#open()).getAllKeysFromIndex("documents", "recent", IDBKeyRange.upperBound([1], true));
  }

  async heads(): Promise<readonly DocumentHead[]> {
    return (await this.#open()).getAll("documents");
  }

  async read(id: string): Promise<KeptDocument | undefined> {
    const transaction = (await this.#open()).transaction(stores);
    const [document, content, changes] = await Promise.all([
      transaction.objectStore("documents").get(id),
      transaction.objectStore("contents").get(id),
      transaction.objectStore("changes").getAll(changesOf(id)),
    ]);
    if (document && "text" in document) return { ...document, content: document, changes };
    return document && content && { ...document, content, changes };
  }

  async write(write: DocumentWrite): Promise<void> {
    const database = this.#database ?? (await this.#open());
    const transaction = database.transaction(stores, "readwrite");
    const [contents, changes] = [transaction.objectStore("contents"), transaction.objectStore("changes")];
    const requests: Promise<unknown>[] = [transaction.done];
    if ("content" in write) {
      const { content, ...head } = write;
      requests.push(transaction.objectStore("documents").put(head), contents.put(content, head.id));
      requests.push(changes.delete(changesOf(head.id)));
    } else {
      const { change, ...head } = write;
      const { stamp, number } = change;
      requests.push(
        transaction.objectStore("documents").put(head),
        changes.put(change, [head.id, stamp, number]),
        contents.index("stamp").count(stamp).then(requireContent),
      );
    }
    transaction.commit();
    await Promise.all(requests);
  }

  async remove(ids: readonly string[]): Promise<void> {
    if (ids.length === 0) return;
    const transaction = (await this.#open()).transaction(stores, "readwrite");
    const deletions = ids.flatMap((id) => [
      transaction.objectStore("documents").delete(id),
      transaction.objectStore("contents").delete(id),
      transaction.objectStore("changes").delete(changesOf(id)),
    ]);
    await Promise.all([...deletions, transaction.done]);
  }

  #open(): Promise<IDBPDatabase<Schema>> {
    this.#opening ??= this.#openDatabase().catch((error: unknown) => {
      this.#opening = null;
      throw error;
    });
    return this.#opening;
  }

  async #openDatabase(): Promise<IDBPDatabase<Schema>> {
    const forget = (): void => {
      this.#opening = null;
      this.#database = null;
    };
    const upgrade: OpenDBCallbacks<Schema>["upgrade"] = (database, version, _, transaction) => {
      if (version < 2) {
        for (const name of database.objectStoreNames) database.deleteObjectStore(name);
        const store = database.createObjectStore("documents", { keyPath: "id" });
        store.createIndex("recent", ["listed", "at", "name"]);
      }
      if (version < 3) {
        database.createObjectStore("contents");
        database.createObjectStore("changes");
      }
      transaction.objectStore("contents").createIndex("stamp", "stamp");
    };
    // A newer version of the app, or the user, wants to change or delete the database.
    const blocking = (): void => {
      this.#database?.close();
      forget();
    };
    try {
      // Where site data are blocked, some browsers throw as soon as the property is read.
      if (typeof indexedDB === "undefined") throw new NoStorageError();
      this.#database = await openDB<Schema>(this.#name, databaseVersion, {
        upgrade,
        blocking,
        terminated: forget,
      });
    } catch (error) {
      throw isSwitchedOff(error) ? new NoStorageError() : error;
    }
    return this.#database;
  }
}
