import { createStore, type StoreApi } from "zustand/vanilla";

/** The element around an app. */
export interface AppRoot {
  contains(target: EventTarget | null): boolean;
}

/**
 * The apps on a page, which share its keys and dropped files. An event belongs to the app around its target. Outside
 * all apps, for example without a focus, it belongs to the app used last.
 */
export class PageApps<App extends object> {
  readonly state: StoreApi<{ readonly lastUsed: App | null }> = createStore<{
    readonly lastUsed: App | null;
  }>(() => ({ lastUsed: null }));
  readonly #roots = new Map<App, AppRoot>();

  /** Adds an app and returns the function that removes it. */
  add(app: App, root: AppRoot): () => void {
    this.#roots.set(app, root);
    if (this.state.getState().lastUsed === null) this.use(app);
    return () => {
      this.#roots.delete(app);
      if (this.state.getState().lastUsed !== app) return;
      this.state.setState({ lastUsed: [...this.#roots.keys()].at(-1) ?? null });
    };
  }

  /** Records that the user works with an app. */
  use(app: App): void {
    if (this.state.getState().lastUsed !== app) this.state.setState({ lastUsed: app });
  }

  /** Returns whether an event with this target belongs to an app. */
  owns(app: App, target: EventTarget | null): boolean {
    const [around] = [...this.#roots].find(([, root]) => root.contains(target)) ?? [];
    return (around ?? this.state.getState().lastUsed) === app;
  }

  /** Returns whether a target lies within an app. */
  contains(app: App, target: EventTarget | null): boolean {
    return this.#roots.get(app)?.contains(target) ?? false;
  }
}
