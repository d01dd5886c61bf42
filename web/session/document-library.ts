import { documentKey } from "../document/content-keys";
import { newDocumentId, type OpenDocument } from "./document-store";
import type { DocumentLocks } from "./document-locks";
import type { DocumentStorage } from "./document-storage";
import { openKept, type DocumentSummary } from "./kept-document";
import type { TabMemory } from "./tab-memory";

/** A document that Recent lists. */
export interface RecentDocument extends DocumentSummary {
  /** Where the document is open; null if it is not open. */
  readonly openIn: "this-tab" | "another-tab" | null;
}

export type OpenFailure = "open-in-another-tab" | "missing" | "unreadable";

/** A document read from the storage and locked for this tab. */
export interface LockedDocument {
  readonly document: OpenDocument;
  readonly release: () => void;
}

/** Largest number of documents kept, more than Recent lists; older ones are removed. */
export const maxListedDocuments = 100;
/** Time within which a lock is released, by this tab or by the page before a reload, in milliseconds. */
const releaseTime = 1000;
/** Time within which a new document is locked, even on a busy machine, in milliseconds. */
const newLockTime = 60_000;

/**
 * The documents that the browser stores. A document is open in at most one tab: each tab remembers the id of
 * its document and holds the lock of that document.
 */
export class DocumentLibrary {
  readonly storage: DocumentStorage;
  readonly #locks: DocumentLocks;
  readonly #tab: TabMemory;
  /** The document that this tab has open, and how to release its lock. */
  #open: { readonly id: string; readonly release: Promise<(() => void) | null> } | null = null;

  /** Resolves when the lock of the previous document is released. */
  #released: Promise<void> = Promise.resolve();

  constructor(storage: DocumentStorage, locks: DocumentLocks, tab: TabMemory) {
    this.storage = storage;
    this.#locks = locks;
    this.#tab = tab;
  }

  /** Returns the documents for Recent, the one used last first. */
  async list(): Promise<readonly RecentDocument[]> {
    const [documents, openIds] = await Promise.all([this.storage.list(), this.#locks.openIds()]);
    const openIn = (id: string): RecentDocument["openIn"] => {
      if (id === this.#open?.id) return "this-tab";
      return openIds.has(id) ? "another-tab" : null;
    };
    return documents.map((summary) => ({ ...summary, openIn: openIn(summary.id) }));
  }

  /** Reads and locks a document. The caller either keeps it open with `keepOpen` or releases the lock. */
  async take(id: string): Promise<LockedDocument | OpenFailure> {
    const release = await this.#acquire(id);
    if (!release) return "open-in-another-tab";
    const document = await this.#read(id).catch((): OpenFailure => "unreadable");
    if (typeof document !== "string") return { document, release };
    release();
    return document;
  }

  /**
   * Locks a document that is already in memory. If another tab has opened it meanwhile, returns a copy of it.
   */
  async retake(document: OpenDocument): Promise<LockedDocument> {
    const release = await this.#acquire(document.id);
    if (release) return { document, release };
    const copy = { ...document, id: newDocumentId() };
    return {
      document: copy,
      release: (await this.#locks.acquire(copy.id, releaseTime)) ?? (() => undefined),
    };
  }

  /**
   * Returns the document to continue with: the one that this tab had open; in a new tab, the one used last, unless other tabs
   * are open; else null.
   */
  async resume(): Promise<LockedDocument | null> {
    const last = this.#tab.read();
    if (last === null) return this.#takeLast();
    const taken = await this.take(last);
    if (typeof taken !== "string") return taken;
    // A duplicated tab has the memory of the original tab.
    return taken === "open-in-another-tab" ? this.#copy(last) : null;
  }

  /** Returns whether another tab has a document open. */
  async isOpenElsewhere(): Promise<boolean> {
    const ids = await this.#locks.openIds();
    return [...ids].some((id) => id !== this.#open?.id && id !== this.#tab.read());
  }

  /**
   * Returns the document with which `resume` would continue, if no file contains its last changes. Does not
   * lock it.
   */
  async unsaved(): Promise<{ readonly id: string; readonly name: string } | null> {
    const id = this.#tab.read() ?? (await this.#lastId());
    const document = id === null ? "missing" : await this.#read(id);
    if (typeof document === "string") return null;
    const { project } = document.history.present;
    return documentKey(project) === document.savedKey ? null : { id: document.id, name: project.name };
  }

  /**
   * Records that this tab has a document open instead of the previous one. Without a `release`, locks the
   * document.
   */
  keepOpen({ id }: Pick<OpenDocument, "id">, release?: () => void): void {
    const before = this.#open;
    this.#open = { id, release: release ? Promise.resolve(release) : this.#locks.acquire(id, newLockTime) };
    this.#tab.write(id);
    if (before) this.#released = before.release.then((releaseBefore) => releaseBefore?.());
  }

  /**
   * Removes the unchanged documents of the name and content of one that was just opened, unless a tab has them open: of a file
   * that is opened again, lists have one entry.
   */
  async removeTwins({ id, savedKey, history }: OpenDocument): Promise<void> {
    const { name } = history.present.project;
    const heads = await this.storage.heads();
    for (const head of heads) {
      if (head.id === id || head.isUnchanged !== true) continue;
      if (head.savedKey !== savedKey || head.name !== name) continue;
      // The document that this one has replaced is just being left.
      const release = await this.#acquire(head.id);
      if (!release) continue;
      await this.storage.remove([head.id]);
      release();
    }
  }

  /** Removes unchanged documents, and the oldest ones beyond the limit, unless a tab has them open. */
  async clean(): Promise<void> {
    const [listed, untouched] = await Promise.all([this.storage.list(), this.storage.listUntouched()]);
    // A document is locked before it is stored, so all listed ones that are open are locked by now.
    const openIds = await this.#locks.openIds();
    const surplus = [...untouched, ...listed.slice(maxListedDocuments).map(({ id }) => id)];
    await this.storage.remove(surplus.filter((id) => !openIds.has(id) && id !== this.#open?.id));
  }

  /** The document that this tab has just closed can be opened again at once. */
  async #acquire(id: string): Promise<(() => void) | null> {
    await this.#released;
    return this.#locks.acquire(id, releaseTime);
  }

  async #takeLast(): Promise<LockedDocument | null> {
    const last = await this.#lastId();
    const taken = last === null ? "missing" : await this.take(last);
    return typeof taken === "string" ? null : taken;
  }

  /** Returns the document used last; null if other tabs are open. */
  async #lastId(): Promise<string | null> {
    if (await this.isOpenElsewhere()) return null;
    return (await this.storage.list())[0]?.id ?? null;
  }

  async #copy(id: string): Promise<LockedDocument | null> {
    const document = await this.#read(id);
    return typeof document === "string" ? null : this.retake({ ...document, id: newDocumentId() });
  }

  async #read(id: string): Promise<OpenDocument | OpenFailure> {
    const kept = await this.storage.read(id);
    return kept ? ((await openKept(kept)) ?? "unreadable") : "missing";
  }
}
