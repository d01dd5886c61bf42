import { useEffect, useState } from "react";
import type { App } from "../../app/app";
import { untilState } from "../../session/until-state";

/**
 * Returns whether what opens above the page is to be loaded: after the first mesh, which needs the connection for the engine, or as
 * soon as the user does something or the shell has something to show.
 */
export function useOverlays(app: App): boolean {
  const [isWanted, setWanted] = useState(false);
  useEffect(() => {
    const life = new AbortController();
    const { signal } = life;
    const want = (): void => {
      life.abort();
      setWanted(true);
    };
    for (const type of ["pointerdown", "keydown"])
      window.addEventListener(type, want, { capture: true, signal });
    signal.addEventListener("abort", app.shell.subscribe(want));
    const { message, dialog, notices, isPresenting } = app.shell.getState();
    if (message !== null || dialog !== null || notices.length > 0 || isPresenting) want();
    else untilState(app.run.state, ({ busy }) => !busy, signal).then(want, () => undefined);
    return () => life.abort();
  }, [app]);
  return isWanted;
}
