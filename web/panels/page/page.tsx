import { lazy, useEffect, useState } from "react";
import { openDropped } from "../../commands/drop-actions";
import type { App } from "../../app/app";
import { strings } from "../../strings";
import { AppContext } from "../shared/app-context";
import { ProjectNames } from "../shared/project-names";
import { PageLayout } from "./layout";
import { PanelBoundary } from "../shared/panel-boundary";
import { useCommandHotkeys } from "./hotkeys";
import { fetchAhead } from "../later/later";
import { losePalette } from "../shared/palette";
import { SlotsContext, type Slots } from "../shared/slots";
import { useOverlays } from "./use-overlays";
import { useScheme } from "./use-scheme";
import styles from "./page.module.css";

const Overlays = lazy(() => import("./overlays"));

/** The app with its dialogs, hotkeys and drop target. */
export function Page({ app, slots }: { readonly app: App; readonly slots: Slots }) {
  useCommandHotkeys(app);
  useHeldKeys(app);
  useScheme(app);
  useEffect(() => fetchAhead(app, slots), [app, slots]);
  const hasOverlays = useOverlays(app);
  const dropping = useFileDrop(app);
  return (
    <AppContext value={app}>
      <SlotsContext value={slots}>
        <ProjectNames>
          <PageLayout />
          <PanelBoundary floats onFailed={losePalette}>
            {hasOverlays && <Overlays />}
          </PanelBoundary>
        </ProjectNames>
      </SlotsContext>
      {dropping && <div className={styles["drop"]}>{strings.viewport.drop}</div>}
    </AppContext>
  );
}

/** Notes in the documents of an app whether a key is held down. */
function useHeldKeys(app: App): void {
  useEffect(() => {
    const life = new AbortController();
    const options = { capture: true, signal: life.signal };
    const { documents } = app;
    const note = ({ repeat }: KeyboardEvent): void => {
      documents.held = repeat;
    };
    const release = (): void => void (documents.held = false);
    window.addEventListener("keydown", note, options);
    for (const end of ["keyup", "pointerdown", "blur"]) window.addEventListener(end, release, options);
    return () => life.abort();
  }, [app]);
}

/** Opens files that are dropped on the app. Returns true while a file is dragged over it. */
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
      const files = [...(event.dataTransfer?.files ?? [])];
      if (files.length > 0) void openDropped(app, files);
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
