import { useEffect, useRef, useState, type KeyboardEvent } from "react";
import { describeMesh } from "./mesh-summary";
import { strings } from "../../strings";
import { navigate } from "../../tools/navigation-keys";
import type { Hover } from "../../tools/select-tool";
import type { Viewer } from "../../viewer/viewer";
import {
  useAutosavePending,
  useProject,
  useQualitySpace,
  useRun,
  useStale,
  useView,
} from "../shared/app-context";
import { HoverLabel } from "./hover-label";
import { Legend } from "./legend";
import { PatchRoleLabels } from "./patch-role-labels";
import { PositionMarker, ProblemMarkers } from "./problem-markers";
import { CutBar, MeshBadge, MouseHint, ViewNotice } from "./viewport-overlays";
import type { Layout } from "../shared/use-layout";
import { useViewer } from "./use-viewer";
import styles from "./viewport-panel.module.css";

/** The canvas with the labels, markers and controls above it. */
export function ViewportPanel({ layout }: { readonly layout: Layout }) {
  const container = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const [hover, setHover] = useState<Hover | null>(null);
  const { viewer, trouble } = useViewer(container, canvas, setHover);
  return (
    <main className={styles["view"]}>
      <ViewState container={container} />
      <div ref={container} className={styles["canvasBox"]} data-testid="viewport">
        <ViewCanvas canvas={canvas} viewer={viewer} />
        {viewer && <ProblemMarkers viewer={viewer} />}
        {viewer && <PositionMarker viewer={viewer} />}
        {viewer && <PatchRoleLabels viewer={viewer} />}
        {hover && <HoverLabel hover={hover} />}
      </div>
      {trouble && <ViewNotice trouble={trouble} />}
      <CutBar />
      <MeshBadge />
      {!trouble && <Legend />}
      {layout !== "phone" && <MouseHint />}
    </main>
  );
}

interface ViewCanvasProps {
  readonly canvas: React.RefObject<HTMLCanvasElement | null>;
  readonly viewer: Viewer | null;
}

/** The picture, with a summary for screen readers. Keys move the camera. */
function ViewCanvas({ canvas, viewer }: ViewCanvasProps) {
  const project = useProject();
  const mesh = useRun((state) => state.mesh);
  const space = useQualitySpace();
  const cut = useView((state) => state.cut.enabled);
  const stale = useStale();
  const summary = [
    strings.viewport.label,
    ": ",
    describeMesh(project, mesh, space),
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

/** Copies the state of the mesh to attributes of the viewport element, for tests. */
function ViewState({ container }: { readonly container: React.RefObject<HTMLDivElement | null> }) {
  const mesh = useRun((state) => state.mesh);
  const busy = useRun((state) => state.busy);
  const front = useRun((state) => state.progress?.frontFaces ?? (state.mesh?.volume.front.length ?? 0) / 3);
  const drawnFront = useRun((state) => state.front && state.front.length / 9);
  const stale = useStale();
  const pending = useAutosavePending();
  useEffect(() => {
    const data = container.current?.dataset;
    if (!data) return;
    data["tets"] = String(mesh?.report.tetrahedra ?? 0);
    data["status"] = mesh?.report.status ?? "none";
    data["fingerprint"] = mesh?.report.fingerprint ?? "";
    data["front"] = String(front);
    if (drawnFront === null) delete data["frontDrawn"];
    else data["frontDrawn"] = String(drawnFront);
    data["stale"] = String(stale);
    data["busy"] = String(busy);
    data["autosaved"] = String(!pending);
  }, [container, mesh, front, drawnFront, stale, busy, pending]);
  return null;
}
