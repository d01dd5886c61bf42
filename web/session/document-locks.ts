/**
 * Registers which documents are open in the tabs of the browser, so that two tabs never write the same
 * document.
 */
export interface DocumentLocks {
  /**
   * Marks a document as open here. Returns a function that ends this, or null if another tab has the document open.
   * Waits up to `patience` milliseconds for a tab that is about to close it.
   */
  readonly acquire: (id: string, patience: number) => Promise<(() => void) | null>;
  /** Returns the ids of the documents that are open, in this tab or another. */
  readonly openIds: () => Promise<ReadonlySet<string>>;
}

const prefix = "tetrafront-document-";
const noLock = (): void => undefined;

/** Web Locks: the browser releases them when a tab is closed or crashes. Without them, every document is free. */
export class BrowserLocks implements DocumentLocks {
  readonly #manager: LockManager | undefined = "locks" in navigator ? navigator.locks : undefined;

  acquire(id: string, patience: number): Promise<(() => void) | null> {
    const manager = this.#manager;
    if (!manager) return Promise.resolve(noLock);
    const options = { signal: AbortSignal.timeout(patience) };
    return new Promise((resolve) => {
      manager
        .request(`${prefix}${id}`, options, () => new Promise<void>((release) => resolve(release)))
        // The signal has ended the wait.
        .catch(() => resolve(null));
    });
  }

  async openIds(): Promise<ReadonlySet<string>> {
    const { held = [] } = (await this.#manager?.query()) ?? {};
    const names = held.flatMap(({ name }) => (name?.startsWith(prefix) ? [name.slice(prefix.length)] : []));
    return new Set(names);
  }
}
