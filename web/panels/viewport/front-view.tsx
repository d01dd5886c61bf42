import { useRef } from "react";
import { Legend } from "./legend";
import { useViewer } from "./use-viewer";
import { ViewCanvas } from "./view-canvas";
import { ViewNotice } from "./viewport-overlays";
import { ViewState } from "./view-state";
import styles from "./viewport-panel.module.css";

const noHover = (): void => undefined;

/** The view without the tools that change a model. */
export function FrontView() {
  const container = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const { viewer, trouble } = useViewer(container, canvas, noHover);
  return (
    <main className={styles["view"]}>
      <ViewState container={container} />
      <div ref={container} className={styles["canvasBox"]} data-testid="viewport">
        <ViewCanvas canvas={canvas} viewer={viewer} />
      </div>
      {trouble ? <ViewNotice trouble={trouble} /> : <Legend />}
    </main>
  );
}
