import { lazy, useEffect, useState } from "react";
import { openDropped } from "../commands/project-actions";
import type { App } from "../app/app";
import { strings } from "../strings";
import { AppContext } from "./app-context";
import { PageLayout } from "./layout";
import { PanelBoundary } from "./panel-boundary";
import { fetchAhead } from "./later";
import { losePalette } from "./palette";
import { useCommandHotkeys } from "./use-hotkeys";
import styles from "./page.module.css";

const Overlays = lazy(() => import("./overlays"));

/** The app with its dialogs, hotkeys and drop target. */
export function Page({ app }: { readonly app: App }) {
  useCommandHotkeys(app);
  useHeldKeys(app);
  useEffect(fetchAhead, []);
  const dropping = useFileDrop(app);
  return (
    <AppContext value={app}>
      <PageLayout />
      <PanelBoundary floats onFailed={losePalette}>
        <Overlays />
      </PanelBoundary>
      {dropping && <div className={styles["drop"]}>{strings.viewport.drop}</div>}
    </AppContext>
  );
}

/** Tells the document while a key is held down. */
function useHeldKeys({ documents }: App): void {
  useEffect(() => {
    const life = new AbortController();
    const options = { capture: true, signal: life.signal };
    const note = ({ repeat }: KeyboardEvent): void => void (documents.held = repeat);
    const release = (): void => void (documents.held = false);
    window.addEventListener("keydown", note, options);
    for (const end of ["keyup", "pointerdown", "blur"]) window.addEventListener(end, release, options);
    return () => life.abort();
  }, [documents]);
}

/** A project file dropped anywhere on the page is opened. True while one hovers above it. */
function useFileDrop(app: App): boolean {
  const [dropping, setDropping] = useState(false);
  useEffect(() => {
    const onDragOver = (event: DragEvent): void => {
      if (!event.dataTransfer?.types.includes("Files")) return;
      event.preventDefault();
      setDropping(true);
    };
    const onDragLeave = (event: DragEvent): void => {
      if (event.relatedTarget === null) setDropping(false);
    };
    const onDrop = (event: DragEvent): void => {
      event.preventDefault();
      setDropping(false);
      const file = event.dataTransfer?.files[0];
      if (file) void openDropped(app, file);
    };
    window.addEventListener("dragover", onDragOver);
    window.addEventListener("dragleave", onDragLeave);
    window.addEventListener("drop", onDrop);
    return () => {
      window.removeEventListener("dragover", onDragOver);
      window.removeEventListener("dragleave", onDragLeave);
      window.removeEventListener("drop", onDrop);
    };
  }, [app]);
  return dropping;
}
