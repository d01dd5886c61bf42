import type { StoreApi } from "zustand/vanilla";

/** A state that can be read and followed: a store, or a value computed from stores. */
export type Readable<State> = Pick<StoreApi<State>, "getState" | "getInitialState" | "subscribe">;

/** Returns the state of a source. The value that is being computed then depends on it. */
export type Read = <State>(source: Pick<Readable<State>, "getState" | "subscribe">) => State;

type Source = Parameters<Read>[0];
type Listener<Value> = (value: Value, before: Value) => void;

/**
 * A value computed from stores and other such values. It is computed when it is read, and only if a source has changed since: it is
 * never old, in whatever order the listeners of a store are called. If `compute` returns
 * `before`, its last value, nothing has changed for those who follow it.
 */
export function derived<Value>(compute: (read: Read, before: Value | undefined) => Value): Readable<Value> {
  let known: { readonly value: Value; readonly sources: ReadonlyMap<Source, unknown> } | undefined;
  const followed = new Map<Source, () => void>();
  const listeners = new Set<Listener<Value>>();
  /** The value that listeners know. */
  let told: Value;

  const getState = (): Value => {
    if (known && [...known.sources].every(([source, state]) => source.getState() === state))
      return known.value;
    const sources = new Map<Source, unknown>();
    const read: Read = (source) => {
      const state = source.getState();
      sources.set(source, state);
      return state;
    };
    known = { value: compute(read, known?.value), sources };
    if (listeners.size > 0) follow(sources);
    return known.value;
  };

  const follow = (sources: ReadonlyMap<Source, unknown>): void => {
    for (const [source, stop] of followed) {
      if (sources.has(source)) continue;
      stop();
      followed.delete(source);
    }
    for (const source of sources.keys())
      if (!followed.has(source)) followed.set(source, source.subscribe(tell));
  };

  const tell = (): void => {
    const [value, before] = [getState(), told];
    if (value === before) return;
    told = value;
    for (const listener of [...listeners]) {
      // A listener has changed a source, and all have been told.
      if (told !== value) return;
      listener(value, before);
    }
  };

  const subscribe = (listener: Listener<Value>): (() => void) => {
    listeners.add(listener);
    if (listeners.size === 1) {
      told = getState();
      follow(known?.sources ?? new Map());
    }
    return () => {
      listeners.delete(listener);
      if (listeners.size === 0) follow(new Map());
    };
  };

  return { getState, getInitialState: getState, subscribe };
}

/** Returns `before` instead of a list with the same items, so that nothing has changed. */
export function sameItems<Item>(
  items: readonly Item[],
  before: readonly Item[] | undefined,
): readonly Item[] {
  const isSame = before?.length === items.length && before.every((item, i) => item === items[i]);
  return isSame ? before : items;
}
