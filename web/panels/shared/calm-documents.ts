import { createStore, type StoreApi } from "zustand/vanilla";
import type { DocumentState } from "../../session/document-store";

/** Shortest and longest time between two changes of the panels while the pointer drags, in milliseconds. */
const minGestureMs = 100;
const maxGestureMs = 500;
/** Share of the time that the panels may take while the pointer drags. */
const maxShare = 1 / 15;

const known = new WeakMap<StoreApi<DocumentState>, StoreApi<DocumentState>>();

/**
 * Returns the state of a document for the panels: the same, but during a gesture it changes at most ten times per second, and
 * less often where the panels take long, so that there is time to draw every frame of the view. The end of a gesture is shown
 * at once.
 */
export function calmDocuments(source: StoreApi<DocumentState>): StoreApi<DocumentState> {
  const before = known.get(source);
  if (before) return before;
  const calm = createStore<DocumentState>(() => source.getState());
  let shownAt = -Infinity;
  let gestureMs = minGestureMs;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const show = (): void => {
    clearTimeout(timer);
    timer = undefined;
    const begin = performance.now();
    shownAt = begin;
    calm.setState(source.getState(), true);
    // React renders what has changed in a microtask that is queued before this one.
    queueMicrotask(() => {
      const took = performance.now() - begin;
      gestureMs = Math.min(maxGestureMs, Math.max(minGestureMs, took / maxShare));
    });
  };
  source.subscribe(({ gestureStart }) => {
    const wait = shownAt + gestureMs - performance.now();
    if (gestureStart === null || wait <= 0) show();
    else timer ??= setTimeout(show, wait);
  });
  known.set(source, calm);
  return calm;
}
