import { VisuallyHidden } from "@mantine/core";
import { useRef } from "react";
import { shareStrings } from "../strings/share";
import { usePlayer } from "../panels/player/use-player";
import { FrontLegend } from "../panels/player/front-legend";
import { teachingSlots } from "../panels/slots";
import { usePageScroll } from "./use-page-scroll";
import { useViewer } from "../../panels/viewport/use-viewer";
import { ViewCanvas } from "../../panels/viewport/view-canvas";
import { ViewCube } from "../../panels/viewport/view-cube";
import { ViewNotice } from "../../panels/viewport/viewport-overlays";
import { ViewState } from "../../panels/viewport/view-state";
import styles from "../../panels/viewport/viewport-panel.module.css";

const { Overlay } = teachingSlots;

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
      <VisuallyHidden component="h1">{document.title}</VisuallyHidden>
      <ViewState container={container} />
      <div ref={container} className={styles["canvasBox"]} data-testid="viewport">
        <ViewCanvas canvas={canvas} viewer={viewer} />
        {viewer && <ViewCube viewer={viewer} />}
        {viewer && isReplaying && <Overlay viewer={viewer} />}
      </div>
      <p aria-hidden className={styles["wheelHint"]} data-shown={isHinted || undefined}>
        {isHinted && shareStrings.wheelHint}
      </p>
      {trouble ? <ViewNotice trouble={trouble} /> : isReplaying && <FrontLegend />}
    </main>
  );
}
