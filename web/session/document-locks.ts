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

/** Returns the locks of the browser; in pages that have none, because they are not secure, those that tabs agree on. */
export function documentLocks(): DocumentLocks {
  // The types promise locks to all pages.
  const { locks } = navigator as Partial<Pick<Navigator, "locks">>;
  return locks ? new BrowserLocks(locks) : new ChannelLocks();
}

/** Web Locks: the browser releases them when a tab is closed or crashes. */
class BrowserLocks implements DocumentLocks {
  readonly #manager: LockManager;

  constructor(manager: LockManager) {
    this.#manager = manager;
  }

  acquire(id: string, patience: number): Promise<(() => void) | null> {
    const options = { signal: AbortSignal.timeout(patience) };
    return new Promise((resolve) => {
      this.#manager
        .request(`${prefix}${id}`, options, () => new Promise<void>((release) => resolve(release)))
        // The signal has ended the wait.
        .catch(() => resolve(null));
    });
  }

  async openIds(): Promise<ReadonlySet<string>> {
    const { held = [] } = await this.#manager.query();
    const names = held.flatMap(({ name }) => (name?.startsWith(prefix) ? [name.slice(prefix.length)] : []));
    return new Set(names);
  }
}

/** What tabs say to each other. */
type LockMessage =
  /** Asks which documents are open in other tabs. */
  | { readonly kind: "ask" }
  /** The documents that are open in a tab, or that it is about to open. */
  | {
      readonly kind: "open";
      readonly tab: string;
      readonly ids: readonly string[];
      readonly wanted: readonly string[];
    };

/** Time within which the other tabs answer, even if they are busy, in milliseconds. */
const answerTime = 250;

/**
 * Locks by agreement: each tab answers which documents it has open, as long as it lives. If two tabs want the same document at the
 * same time, the one with the lesser name gets it.
 */
export class ChannelLocks implements DocumentLocks {
  readonly #channel: BroadcastChannel;
  readonly #tab = Array.from(crypto.getRandomValues(new Uint32Array(4)), (part) => part.toString(36)).join(
    "-",
  );
  readonly #open = new Set<string>();
  readonly #wanted = new Set<string>();
  readonly #listeners = new Set<(message: Extract<LockMessage, { readonly kind: "open" }>) => void>();

  constructor(name = `${prefix}locks`) {
    this.#channel = new BroadcastChannel(name);
    this.#channel.onmessage = ({ data }: MessageEvent<LockMessage>) => {
      if (data.kind === "open") for (const listener of this.#listeners) listener(data);
      else this.#tell();
    };
  }

  async acquire(id: string, patience: number): Promise<(() => void) | null> {
    this.#wanted.add(id);
    try {
      const end = performance.now() + patience;
      while ((await this.#others()).get(id) !== undefined) if (performance.now() > end) return null;
      this.#open.add(id);
      this.#tell();
      return () => void this.#open.delete(id);
    } finally {
      this.#wanted.delete(id);
    }
  }

  async openIds(): Promise<ReadonlySet<string>> {
    const others = await this.#others();
    const isOpen = ([, state]: readonly [string, "open" | "wanted"]): boolean => state === "open";
    return new Set([...this.#open, ...[...others].filter(isOpen).map(([id]) => id)]);
  }

  /** Ends the answers, as the end of the tab does. */
  close(): void {
    this.#channel.onmessage = null;
    this.#channel.close();
  }

  #tell(): void {
    this.#post({ kind: "open", tab: this.#tab, ids: [...this.#open], wanted: [...this.#wanted] });
  }

  /** Returns which documents the other tabs have open, or are about to open before this one may. */
  async #others(): Promise<ReadonlyMap<string, "open" | "wanted">> {
    const found = new Map<string, "open" | "wanted">();
    const listen = ({ tab, ids, wanted }: Extract<LockMessage, { readonly kind: "open" }>): void => {
      if (tab < this.#tab) for (const id of wanted) found.set(id, "wanted");
      for (const id of ids) found.set(id, "open");
    };
    this.#listeners.add(listen);
    this.#post({ kind: "ask" });
    await new Promise((resolve) => setTimeout(resolve, answerTime));
    this.#listeners.delete(listen);
    return found;
  }

  #post(message: LockMessage): void {
    this.#channel.postMessage(message);
  }
}
