/**
 * Notices the end of a worker that says nothing: one that was killed, or that ran out of memory, sends no event. The browser then
 * releases the lock that it held.
 */

/** Asks a worker to hold a lock of this name as long as it lives. */
export interface LifeRequest {
  readonly kind: "live";
  readonly lock: string;
}

/** Says that the worker holds the lock. */
export interface LifeReply {
  readonly kind: "lives";
}

/** Locks, which browsers have on secure pages only. */
const locks = (): LockManager | undefined =>
  (globalThis as { readonly navigator?: Partial<Pick<Navigator, "locks">> }).navigator?.locks;

/** In a worker: holds the lock from now on. `onHeld` is called when it is held. */
export function live({ lock }: LifeRequest, onHeld: () => void): void {
  void locks()?.request(lock, () => {
    onHeld();
    return new Promise(() => undefined);
  });
}

/** In the page: watches one worker. */
export class LifeWatch {
  readonly request: LifeRequest = { kind: "live", lock: `tetrafront-worker-${crypto.randomUUID()}` };
  readonly #end = new AbortController();
  readonly #onEnd: () => void;

  /** Returns null where nothing can be watched. */
  static of(onEnd: () => void): LifeWatch | null {
    return locks() ? new LifeWatch(onEnd) : null;
  }

  private constructor(onEnd: () => void) {
    this.#onEnd = onEnd;
  }

  /** The worker holds its lock: the page gets it when the worker has ended. */
  begin(): void {
    const { signal } = this.#end;
    void locks()
      ?.request(this.request.lock, { signal }, () => {
        if (!signal.aborted) this.#onEnd();
      })
      // The watch was stopped.
      .catch(() => undefined);
  }

  stop(): void {
    this.#end.abort();
  }
}
