/** Work of which only the last answer counts. A new run ends the one before. */
export class LatestTask {
  #abort: AbortController | null = null;

  /**
   * Ends the work before, and does this one. Calls `done` with its answer, unless other work was begun meanwhile or this was
   * cancelled. Rejects if the work fails, but not if it was ended.
   */
  async run<Answer>(
    work: (signal: AbortSignal) => Promise<Answer>,
    done: (answer: Answer) => void = () => undefined,
  ): Promise<void> {
    this.cancel();
    const abort = new AbortController();
    this.#abort = abort;
    try {
      const answer = await work(abort.signal);
      if (this.#ends(abort)) done(answer);
    } catch (error) {
      if (this.#ends(abort)) throw error;
    }
  }

  /** Ends the work; its answer is not used. */
  cancel(): void {
    this.#abort?.abort();
    this.#abort = null;
  }

  /** Returns whether this work was still the last one. */
  #ends(abort: AbortController): boolean {
    if (abort.signal.aborted) return false;
    if (this.#abort === abort) this.#abort = null;
    return true;
  }
}

/** A latest task for each key. */
export class LatestTasks<Key> {
  readonly #byKey = new Map<Key, LatestTask>();

  /** Returns the task of a key. */
  of(key: Key): LatestTask {
    const known = this.#byKey.get(key) ?? new LatestTask();
    this.#byKey.set(key, known);
    return known;
  }

  /** Cancels all tasks but those of some keys. */
  cancelBut(keys: { readonly has: (key: Key) => boolean }): void {
    for (const [key, task] of this.#byKey) {
      if (keys.has(key)) continue;
      task.cancel();
      this.#byKey.delete(key);
    }
  }
}

/** Resolves after a time in milliseconds, or as soon as it is aborted. */
export function pause(ms: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const end = (): void => {
      clearTimeout(timer);
      signal.removeEventListener("abort", end);
      resolve();
    };
    const timer = setTimeout(end, ms);
    if (signal.aborted) end();
    else signal.addEventListener("abort", end);
  });
}
