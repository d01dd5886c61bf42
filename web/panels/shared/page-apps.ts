import { useEffect, type RefObject } from "react";
import { useStore } from "zustand";
import type { App } from "../../app/app";
import { PageApps } from "../../tools/page-apps";

/** The apps on this page. */
export const pageApps = new PageApps<App>();

/** Registers an app with the element around it, and tracks which app the user works with. */
export function usePageApp(app: App, root: RefObject<HTMLElement | null>): void {
  useEffect(() => {
    const element = root.current;
    if (!element) return undefined;
    const remove = pageApps.add(app, {
      contains: (target) => target instanceof Node && element.contains(target),
    });
    const listening = new AbortController();
    const use = (): void => pageApps.use(app);
    for (const type of ["pointerdown", "focusin"]) {
      element.addEventListener(type, use, { capture: true, signal: listening.signal });
    }
    return () => {
      listening.abort();
      remove();
    };
  }, [app, root]);
}

/** Returns whether this is the app that the user worked with last. */
export function useIsLastUsed(app: App): boolean {
  return useStore(pageApps.state, ({ lastUsed }) => lastUsed === app);
}
