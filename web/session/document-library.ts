import { documentKey } from "../document/content-keys";
import { newDocumentId, type OpenDocument } from "./document-store";
import type { DocumentLocks } from "./document-locks";
import type { DocumentStorage } from "./document-storage";
import { openKept, type DocumentSummary } from "./kept-document";
import type { TabMemory } from "./tab-memory";

/** A document that Recent lists. */
export interface RecentDocument extends DocumentSummary {
  /** Where it is open; null if nowhere. */
  readonly openIn: "this-tab" | "another-tab" | null;
}

export type OpenFailure = "open-in-another-tab" | "missing" | "unreadable";

/** A document read from the storage and locked for this tab. */
export interface LockedDocument {
  readonly document: OpenDocument;
  readonly release: () => void;
}

/** More than Recent needs to list; older documents are removed. */
export const maxListedDocuments = 100;
/** A lock is released within this time, by this tab or by the page before a reload. Milliseconds. */
const releaseTime = 1000;

/**
 * The documents that the browser keeps. No two tabs have the same one open: each tab has its own id in its memory
 * and holds the lock of its document.
 */
export class DocumentLibrary {
  readonly storage: DocumentStorage;
  readonly #locks: DocumentLocks;
  readonly #tab: TabMemory;
  /** The document that this tab has open, and how to release its lock. */
  #open: { readonly id: string; readonly release: Promise<(() => void) | null> } | null = null;

  /** Resolves when the lock of the document before is released. */
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

  /** Locks a document that is in memory already. If another tab has it open by now, returns a copy of it. */
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
   * Returns the document to continue with: the one that this tab had open before a reload; in a new tab, the one used
   * last, unless other tabs are open; else null.
   */
  async resume(): Promise<LockedDocument | null> {
    const own = this.#tab.read();
    if (own === null) return this.#takeLast();
    const taken = await this.take(own);
    if (typeof taken !== "string") return taken;
    // A duplicated tab has the memory of the first one.
    return taken === "open-in-another-tab" ? this.#copy(own) : null;
  }

  /** Returns the document with which `resume` would continue, if no file has its last changes. Does not lock it. */
  async unsaved(): Promise<{ readonly id: string; readonly name: string } | null> {
    const id = this.#tab.read() ?? (await this.#lastId());
    const document = id === null ? "missing" : await this.#read(id);
    if (typeof document === "string") return null;
    const { project } = document.history.present;
    return documentKey(project) === document.savedKey ? null : { id: document.id, name: project.name };
  }

  /** Notes that this tab has a document open, and no longer the one before. Without a `release`, locks it. */
  keepOpen(id: string, release?: () => void): void {
    const before = this.#open;
    this.#open = { id, release: release ? Promise.resolve(release) : this.#locks.acquire(id, releaseTime) };
    this.#tab.write(id);
    if (before) this.#released = before.release.then((releaseBefore) => releaseBefore?.());
  }

  /** Removes documents that are as they were opened, and the oldest ones beyond the limit, unless a tab has them open. */
  async clean(): Promise<void> {
    const [listed, untouched, openIds] = await Promise.all([
      this.storage.list(),
      this.storage.listUntouched(),
      this.#locks.openIds(),
    ]);
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
    if ((await this.#locks.openIds()).size > 0) return null;
    const [last] = await this.storage.list();
    return last?.id ?? null;
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
