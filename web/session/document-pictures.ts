import { openDB, type DBSchema, type IDBPDatabase } from "idb";

interface Schema extends DBSchema {
  pictures: { key: string; value: Blob };
}

/**
 * Small pictures of documents, for lists, in a database of their own: losing one does no harm. Failures are silent for the same
 * reason.
 */
export class DocumentPictures {
  readonly #name: string;
  #opening: Promise<IDBPDatabase<Schema>> | null = null;

  constructor(name = "tetrafront-pictures") {
    this.#name = name;
  }

  /** Returns the picture of a document; null if there is none. */
  async read(id: string): Promise<Blob | null> {
    try {
      return (await (await this.#open()).get("pictures", id)) ?? null;
    } catch {
      return null;
    }
  }

  /** Writes the picture of a document, and removes those of documents that no longer exist. */
  async write(id: string, picture: Blob, existing: readonly string[]): Promise<void> {
    try {
      const transaction = (await this.#open()).transaction("pictures", "readwrite");
      const { store } = transaction;
      await store.put(picture, id);
      for (const key of await store.getAllKeys())
        if (key !== id && !existing.includes(key)) await store.delete(key);
      await transaction.done;
    } catch {
      // The list shows a symbol instead.
    }
  }

  #open(): Promise<IDBPDatabase<Schema>> {
    this.#opening ??= openDB<Schema>(this.#name, 1, {
      upgrade: (database) => void database.createObjectStore("pictures"),
      terminated: () => (this.#opening = null),
    }).catch((error: unknown) => {
      this.#opening = null;
      throw error;
    });
    return this.#opening;
  }
}
