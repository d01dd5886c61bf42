import { createStore, type StoreApi } from "zustand/vanilla";
import type { DocumentState } from "../../session/document-store";

/** Time between two changes of the panels while the pointer drags, in milliseconds. */
const gestureMs = 100;

const known = new WeakMap<StoreApi<DocumentState>, StoreApi<DocumentState>>();

/**
 * Returns the state of a document for the panels: the same, but during a gesture it changes at most ten times per second, so
 * that there is time to draw every frame of the view. The end of a gesture is shown at once.
 */
export function calmDocuments(source: StoreApi<DocumentState>): StoreApi<DocumentState> {
  const before = known.get(source);
  if (before) return before;
  const calm = createStore<DocumentState>(() => source.getState());
  let shownAt = -Infinity;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const show = (): void => {
    clearTimeout(timer);
    timer = undefined;
    shownAt = performance.now();
    calm.setState(source.getState(), true);
  };
  source.subscribe(({ gestureStart }) => {
    const wait = shownAt + gestureMs - performance.now();
    if (gestureStart === null || wait <= 0) show();
    else timer ??= setTimeout(show, wait);
  });
  known.set(source, calm);
  return calm;
}
