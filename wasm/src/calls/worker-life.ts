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

/**
 * Time within which a worker loads and holds its lock, in milliseconds. A worker that dies before sends no event either. A slow line
 * needs up to half of it for the worker's scripts.
 */
const startTime = 60_000;

const locks = (): LockManager | undefined =>
  (globalThis as { readonly navigator?: Partial<Pick<Navigator, "locks">> }).navigator?.locks;

/**
 * Returns a watch that calls `onEnd` once when its worker has ended, or does not hold the lock within the time for its start;
 * undefined without locks.
 */
export function watchLife(onEnd: () => void): LifeWatch | undefined {
  const manager = locks();
  if (manager === undefined) return undefined;
  const lock = `tetrafront-worker-${crypto.randomUUID()}`;
  const end = new AbortController();
  const { signal } = end;
  const report = (): void => {
    if (signal.aborted) return;
    end.abort();
    onEnd();
  };
  const deadline = setTimeout(report, startTime);
  return {
    request: { kind: "live", lock },
    // The request rejects if the watch is stopped.
    begin: () => {
      clearTimeout(deadline);
      void manager.request(lock, { signal }, report).catch(() => undefined);
    },
    stop: () => {
      clearTimeout(deadline);
      end.abort();
    },
  };
}

/** In a worker: holds the lock from now on. `onHeld` is called when it is held. */
function live({ lock }: LifeRequest, onHeld: () => void): void {
  void locks()?.request(lock, () => {
    onHeld();
    return new Promise(() => undefined);
  });
}

/**
 * In a worker: returns the receiver of its messages. It holds the lock of a life request and says so by `post`. The messages after
 * the request wait until then, so that a long task does not begin unwatched.
 */
export function receiveWatched<M extends object>(
  handle: (message: M) => void,
  post: (reply: LifeReply) => void,
): (message: M | LifeRequest) => void {
  let waiting: M[] | null = null;
  const release = (): void => {
    post({ kind: "lives" });
    const messages = waiting ?? [];
    waiting = null;
    messages.forEach(handle);
  };
  return (message) => {
    if ("lock" in message) {
      waiting = [];
      live(message, release);
    } else if (waiting) waiting.push(message);
    else handle(message);
  };
}
