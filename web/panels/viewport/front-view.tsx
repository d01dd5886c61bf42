import { lazy, Suspense, useRef } from "react";
import { shareStrings } from "../../strings/share";
import { usePlayer } from "../player/use-player";
import { Legend } from "./legend";
import { usePageScroll } from "./use-page-scroll";
import { useViewer } from "./use-viewer";
import { ViewCanvas } from "./view-canvas";
import { ViewNotice } from "./viewport-overlays";
import { ViewState } from "./view-state";
import styles from "./viewport-panel.module.css";

const LensLabels = lazy(async () => ({ default: (await import("./lens-labels")).LensLabels }));

const noHover = (): void => undefined;

/** The view without the tools that change a model. */
export function FrontView() {
  const container = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const { viewer, trouble } = useViewer(container, canvas, noHover);
  const isHinted = usePageScroll(container, viewer);
  const isReplaying = usePlayer(({ trace }) => trace !== null);
  return (
    <main className={styles["view"]}>
      <ViewState container={container} />
      <div ref={container} className={styles["canvasBox"]} data-testid="viewport">
        <ViewCanvas canvas={canvas} viewer={viewer} />
        {viewer && isReplaying && (
          <Suspense fallback={null}>
            <LensLabels viewer={viewer} />
          </Suspense>
        )}
      </div>
      <p aria-hidden className={styles["wheelHint"]} data-shown={isHinted || undefined}>
        {isHinted && shareStrings.wheelHint}
      </p>
      {trouble ? <ViewNotice trouble={trouble} /> : <Legend />}
    </main>
  );
}
