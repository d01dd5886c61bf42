import { createStore, type StoreApi } from "zustand/vanilla";
import { isListed, type DocumentState, type DocumentStore } from "./document-store";
import type { DocumentStorage } from "./document-storage";
import { documentWrite, type Stored } from "./document-write";

export interface AutosaveState {
  /**
   * Whether there is a change that is not yet in the storage. The user is then warned before leaving the
   * page.
   */
  readonly pending: boolean;
  /** Why the last attempt failed; null if it succeeded. */
  readonly failure: string | null;
}

/** Minimum delay between a change and its writing, in milliseconds: the page shows the change first. */
const minDelay = 20;
/** Copying a large project blocks the page: wait for this multiple of the time that the last copy took. */
const delayPerBlockingTime = 4;
/** Delay after a failed attempt, in milliseconds. It doubles with each further failure. */
const retryDelay = { first: 500, max: 30_000 };

/** The parts of the window and its document whose events announce that the user leaves the page. */
export interface PageEvents {
  readonly window: Pick<EventTarget, "addEventListener" | "removeEventListener">;
  readonly document: Pick<EventTarget, "addEventListener" | "removeEventListener"> & {
    readonly visibilityState: DocumentVisibilityState;
  };
}

/**
 * Writes the open document to the browser's storage: a few milliseconds after each change, and at once when
 * the user leaves the page. If the storage fails, writing is repeated until it succeeds. A document that is
 * no longer open stays in the queue until it is written.
 */
export class Autosave {
  readonly #documents: DocumentStore;
  readonly #storage: DocumentStorage;
  /** States to be written, by document. */
  readonly #queue = new Map<string, DocumentState>();
  /** The state last put into the queue. */
  #noted: DocumentState | null = null;
  /** The states written last, by document, until they are stored. */
  readonly #writing = new Map<string, DocumentState>();
  /** What the storage has of the document that was written last; null if that is not known, or about to be replaced. */
  #stored: Stored | null = null;
  /** What it will have when the last write is complete. */
  #issued: Stored | null = null;
  #running = 0;
  #timer: ReturnType<typeof setTimeout> | null = null;
  #lastBlockingTime = 0;
  #failures = 0;
  readonly state: StoreApi<AutosaveState> = createStore<AutosaveState>(() => ({
    pending: false,
    failure: null,
  }));

  constructor(documents: DocumentStore, storage: DocumentStorage) {
    this.#documents = documents;
    this.#storage = storage;
  }

  /** Writes the open document and all its changes from now on. Returns a function that stops this. */
  follow(): () => void {
    this.#note(this.#documents.state.getState());
    return this.#documents.state.subscribe((state) => this.#note(state));
  }

  /**
   * Writes at once when the page is hidden or left, and warns the user who leaves it while a change is not
   * yet written.
   */
  followPage({ window, document }: PageEvents): () => void {
    const flush = (): void => void this.flush();
    const flushIfHidden = (): void => {
      if (document.visibilityState === "hidden") flush();
    };
    const warn = (event: Event): void => {
      flush();
      if (this.state.getState().pending) event.preventDefault();
    };
    window.addEventListener("pagehide", flush);
    window.addEventListener("beforeunload", warn);
    document.addEventListener("visibilitychange", flushIfHidden);
    return () => {
      window.removeEventListener("pagehide", flush);
      window.removeEventListener("beforeunload", warn);
      document.removeEventListener("visibilitychange", flushIfHidden);
    };
  }

  /** Writes all states in the queue. All transactions are issued before this returns. */
  async flush(): Promise<void> {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    const states = [...this.#queue.values()];
    this.#queue.clear();
    await Promise.all(states.map((state) => this.#write(state)));
  }

  /** Removes a document from the queue, because it is about to be removed from the storage. */
  forget(id: string): void {
    this.#queue.delete(id);
    if (this.#issued?.id === id) this.#stored = this.#issued = null;
    this.#update();
  }

  #note(state: DocumentState): void {
    if (state.gestureStart !== null || isSame(state, this.#noted)) return;
    this.#noted = state;
    this.#queue.set(state.id, state);
    this.#update();
    this.#schedule(Math.max(minDelay, delayPerBlockingTime * this.#lastBlockingTime));
  }

  #schedule(delay: number): void {
    if (this.#timer !== null || this.#running > 0) return;
    this.#timer = setTimeout(() => void this.flush(), delay);
  }

  async #write(state: DocumentState): Promise<void> {
    this.#running += 1;
    this.#writing.set(state.id, state);
    try {
      const stored = await this.#issue(state);
      // A write that was issued meanwhile begins where this one did.
      if (stored === this.#issued) this.#stored = stored;
      if (this.#writing.get(state.id) === state) this.#writing.delete(state.id);
      this.#failures = 0;
      this.#update(null);
    } catch (error) {
      this.#failures += 1;
      this.#stored = null;
      // A later change of the same document replaces it.
      const last = this.#writing.get(state.id);
      if (last && !this.#queue.has(state.id)) this.#queue.set(state.id, last);
      this.#update(error instanceof Error ? error.message : String(error));
    } finally {
      this.#running -= 1;
      this.#update();
      if (this.#queue.size > 0) this.#schedule(this.#nextDelay());
    }
  }

  /** Starts to write. Only this part blocks the page; the storage does the rest in the background. */
  async #issue(state: DocumentState): Promise<Stored> {
    const started = performance.now();
    const { write, stored } = documentWrite(state, this.#stored, Date.now(), isListed(state));
    this.#issued = stored;
    if ("content" in write) this.#stored = null;
    const writing = this.#storage.write(write);
    this.#lastBlockingTime = performance.now() - started;
    await writing;
    return stored;
  }

  #nextDelay(): number {
    if (this.#failures === 0) return Math.max(minDelay, delayPerBlockingTime * this.#lastBlockingTime);
    return Math.min(retryDelay.max, retryDelay.first * 2 ** (this.#failures - 1));
  }

  #update(failure: string | null = this.state.getState().failure): void {
    const pending = this.#queue.size > 0 || this.#running > 0;
    const before = this.state.getState();
    if (pending !== before.pending || failure !== before.failure) this.state.setState({ pending, failure });
  }
}

function isSame(state: DocumentState, other: DocumentState | null): boolean {
  return (
    state.id === other?.id &&
    state.history === other.history &&
    state.savedKey === other.savedKey &&
    state.file === other.file
  );
}
