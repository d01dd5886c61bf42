import type { StoreApi } from "zustand/vanilla";

/** Resolves when the state of a store fulfils a condition, at once if it does already. Rejects if it is aborted. */
export async function untilState<State>(
  store: Pick<StoreApi<State>, "getState" | "subscribe">,
  isFulfilled: (state: State) => boolean,
  signal?: AbortSignal,
): Promise<void> {
  signal?.throwIfAborted();
  if (isFulfilled(store.getState())) return;
  await new Promise<void>((resolve, reject) => {
    const end = (): void => {
      stop();
      signal?.removeEventListener("abort", end);
      if (signal?.aborted === true) reject(signal.reason as Error);
      else resolve();
    };
    const stop = store.subscribe((state) => isFulfilled(state) && end());
    signal?.addEventListener("abort", end);
  });
}
