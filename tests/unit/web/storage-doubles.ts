import type { DocumentLocks } from "../../../web/session/document-locks";
import type { DocumentStorage } from "../../../web/session/document-storage";
import { documentWrite, type DocumentWrite } from "../../../web/session/document-write";
import type { OpenDocument } from "../../../web/session/document-store";
import type { KeptDocument } from "../../../web/session/kept-document";
import type { TabMemory } from "../../../web/session/tab-memory";

/** Returns a document as the storage has it after its first write. */
export const keptDocument = (document: OpenDocument, now: number, isListed: boolean): KeptDocument =>
  afterWrite(undefined, documentWrite(document, null, now, isListed).write);

/** Returns what the storage has of a document after a write. */
export function afterWrite(before: KeptDocument | undefined, write: DocumentWrite): KeptDocument {
  if ("content" in write) return { ...write, changes: [] };
  if (!before) throw new Error("There is no content");
  const { change, ...head } = write;
  const others = before.changes.filter((one) => one.number !== change.number || one.stamp !== change.stamp);
  const changes = [...others, change].sort((a, b) => a.number - b.number);
  return { ...before, ...head, changes };
}

/** Stores documents like IndexedDB: as copies, in the order of their writes. */
export class MemoryStorage implements DocumentStorage {
  readonly documents = new Map<string, KeptDocument>();
  /** Number of calls of `write`. */
  writes = 0;
  /** Error with which every write fails, until it is reset. */
  failure: string | null = null;
  /** Duration of each write in milliseconds; it does not block the page. */
  latency = 0;

  list() {
    const listed = [...this.documents.values()].filter((document) => document.listed === 1);
    return Promise.resolve(listed.sort((a, b) => b.at - a.at));
  }

  listUntouched() {
    return Promise.resolve(
      [...this.documents.values()].filter(({ listed }) => listed === 0).map(({ id }) => id),
    );
  }

  heads() {
    return Promise.resolve([...this.documents.values()]);
  }

  read(id: string) {
    return Promise.resolve(structuredClone(this.documents.get(id)));
  }

  write(write: DocumentWrite): Promise<void> {
    this.writes += 1;
    if (this.failure !== null) return Promise.reject(new Error(this.failure));
    const before = this.documents.get(write.id);
    if (!before && !("content" in write)) return Promise.reject(new Error("There is no content"));
    this.documents.set(write.id, afterWrite(before, structuredClone(write)));
    if ("change" in write && write.change.stamp !== before?.content.stamp)
      return Promise.reject(new Error("The content was replaced"));
    return this.latency === 0
      ? Promise.resolve()
      : new Promise((resolve) => setTimeout(resolve, this.latency));
  }

  remove(ids: readonly string[]): Promise<void> {
    for (const id of ids) this.documents.delete(id);
    return Promise.resolve();
  }
}

/** A database in which some writes fail. Writes end later than they are issued, in the same order. */
export class UnreliableStorage extends MemoryStorage {
  isRepaired = false;
  readonly #next: () => { readonly fails: boolean; readonly after: number };
  #last: Promise<unknown> = Promise.resolve();

  /** @param next Returns whether a write fails, and after how many milliseconds it is complete. */
  constructor(next: () => { readonly fails: boolean; readonly after: number }) {
    super();
    this.#next = next;
  }

  override write(write: DocumentWrite): Promise<void> {
    const { fails, after } = this.#next();
    const before = this.#last;
    const completed = async (): Promise<void> => {
      await before;
      await new Promise((resolve) => setTimeout(resolve, after));
      if (fails && !this.isRepaired) throw new Error("The write has failed");
      await super.write(write);
    };
    const writing = completed();
    this.#last = writing.catch(() => undefined);
    return writing;
  }
}

/**
 * The database of a browser whose tab may be killed: a write is complete some time after it was issued, in the order of
 * issue. What is then not complete never happens, and nothing happens in part.
 */
export class CrashingStorage extends MemoryStorage {
  readonly #latency: () => number;
  #last: Promise<void> = Promise.resolve();
  #isKilled = false;

  /** @param latency Returns the duration of a write, in milliseconds. */
  constructor(latency: () => number) {
    super();
    this.#latency = latency;
  }

  override write(write: DocumentWrite): Promise<void> {
    // The database copies the value at once: later changes do not count.
    const copy = structuredClone(write);
    const before = this.#last;
    this.#last = this.#completed(before, copy);
    return this.#last;
  }

  /** Ends all writes that are not complete. */
  kill(): void {
    this.#isKilled = true;
  }

  async #completed(before: Promise<void>, write: DocumentWrite): Promise<void> {
    await before;
    await new Promise((resolve) => setTimeout(resolve, this.#latency()));
    // The tab has no process that a promise could tell.
    if (this.#isKilled) await new Promise(() => undefined);
    await super.write(write);
  }
}

/** The locks of a browser with several tabs. */
export class MemoryLocks implements DocumentLocks {
  readonly held = new Set<string>();

  acquire(id: string) {
    if (this.held.has(id)) return Promise.resolve(null);
    this.held.add(id);
    return Promise.resolve(() => void this.held.delete(id));
  }

  openIds() {
    return Promise.resolve(new Set(this.held));
  }
}

export class MemoryTab implements TabMemory {
  id: string | null = null;

  read(): string | null {
    return this.id;
  }

  write(id: string): void {
    this.id = id;
  }
}
