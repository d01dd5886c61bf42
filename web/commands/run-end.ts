import type { App } from "../app/app";

/** Resolves when no run is active. */
export function runEnd({ run }: App): Promise<void> {
  if (!run.state.getState().busy) return Promise.resolve();
  return new Promise((resolve) => {
    const stop = run.state.subscribe(({ busy }) => {
      if (busy) return;
      stop();
      resolve();
    });
  });
}
