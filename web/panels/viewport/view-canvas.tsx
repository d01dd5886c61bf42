import type { KeyboardEvent, RefObject } from "react";
import { strings } from "../../strings";
import { navigate } from "../../tools/navigation-keys";
import type { Viewer } from "../../viewer/viewer";
import { useProject, useQualitySpace, useRun, useStale, useView } from "../shared/app-context";
import { describeMesh } from "./mesh-summary";
import styles from "./viewport-panel.module.css";

interface ViewCanvasProps {
  readonly canvas: RefObject<HTMLCanvasElement | null>;
  readonly viewer: Viewer | null;
}

/** The picture, with a summary for screen readers. Keys move the camera. */
export function ViewCanvas({ canvas, viewer }: ViewCanvasProps) {
  const project = useProject();
  const mesh = useRun((state) => state.mesh);
  const outcome = useRun((state) => state.outcome);
  const space = useQualitySpace();
  const cut = useView((state) => state.cut.enabled);
  const stale = useStale();
  const summary = [
    strings.viewport.label,
    ": ",
    describeMesh(project, { mesh, outcome }, space),
    cut ? strings.viewport.summaryCut : "",
    stale ? strings.viewport.summaryStale : "",
    ` ${strings.viewport.keys}`,
  ].join("");
  const onKeyDown = (event: KeyboardEvent): void => {
    if (viewer && navigate(viewer, event.nativeEvent)) event.preventDefault();
  };
  return (
    <canvas
      ref={canvas}
      className={styles["canvas"]}
      data-testid="viewport-canvas"
      role="img"
      aria-label={summary}
      tabIndex={0}
      onKeyDown={onKeyDown}
    />
  );
}
