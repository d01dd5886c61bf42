/**
 * Notices in a browser that a worker has ended without a word: one that was killed, or that ran out of memory, sends no event. The
 * browser then releases the lock that it held. Browsers have locks on secure pages only.
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

export interface LifeWatch {
  readonly request: LifeRequest;
  /** To be called when the worker holds the lock: this thread gets it when the worker has ended. */
  begin(): void;
  stop(): void;
}

/** What a worker that ended without a word is reported as. */
export const ENDED = "the browser ended it, for example because memory ran out";

const locks = (): LockManager | undefined =>
  (globalThis as { readonly navigator?: Partial<Pick<Navigator, "locks">> }).navigator?.locks;

/** Returns a watch that calls `onEnd` when its worker has ended; undefined without locks. */
export function watchLife(onEnd: () => void): LifeWatch | undefined {
  const manager = locks();
  if (manager === undefined) return undefined;
  const lock = `tetrafront-worker-${crypto.randomUUID()}`;
  const end = new AbortController();
  const { signal } = end;
  const report = (): void => {
    if (!signal.aborted) onEnd();
  };
  return {
    request: { kind: "live", lock },
    // The request rejects if the watch is stopped.
    begin: () => void manager.request(lock, { signal }, report).catch(() => undefined),
    stop: () => end.abort(),
  };
}

/** In a worker: holds the lock from now on. `onHeld` is called when it is held. */
export function live({ lock }: LifeRequest, onHeld: () => void): void {
  void locks()?.request(lock, () => {
    onHeld();
    return new Promise(() => undefined);
  });
}
