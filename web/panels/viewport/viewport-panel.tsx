import { useComputedColorScheme } from "@mantine/core";
import { useEffect, useRef, useState, type KeyboardEvent } from "react";
import { describeMesh } from "./mesh-summary";
import { strings } from "../../strings";
import { viewerColors } from "../../ui/theme/theme";
import { navigate } from "../../tools/navigation-keys";
import { SelectTool, type Hover } from "../../tools/select-tool";
import { ToolController } from "../../tools/tool-controller";
import { followSession, shownState } from "../../viewer/follow-session";
import { Viewer } from "../../viewer/viewer";
import { useApp, useAutosavePending, useProject, useRun, useStale, useView } from "../shared/app-context";
import { HoverLabel } from "./hover-label";
import { Legend } from "./legend";
import { pageApps } from "../shared/page-apps";
import { PatchRoleLabels } from "./patch-role-labels";
import { ProblemMarkers } from "./problem-markers";
import { CutBar, MeshBadge, MouseHint, ViewNotice } from "./viewport-overlays";
import type { Layout } from "../shared/use-layout";
import styles from "./viewport-panel.module.css";

type Trouble = "no-webgl" | "context-lost" | null;

/** The canvas with the labels, markers and controls above it. */
export function ViewportPanel({ layout }: { readonly layout: Layout }) {
  const app = useApp();
  const container = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const [viewer, setViewer] = useState<Viewer | null>(null);
  const [trouble, setTrouble] = useState<Trouble>(null);
  const [hover, setHover] = useState<Hover | null>(null);
  const scheme = useComputedColorScheme("dark", { getInitialValueInEffect: false });
  const firstColors = useRef(viewerColors[scheme]);

  useEffect(() => {
    const box = container.current;
    const surface = canvas.current;
    if (!box || !surface) return undefined;
    let made: Viewer;
    try {
      made = new Viewer(box, surface, {
        state: shownState(app),
        colors: firstColors.current,
        motion: !app.still && !window.matchMedia("(prefers-reduced-motion: reduce)").matches,
        multisampling: !app.still,
        meshQueries: app.meshQueries,
        events: {
          onFrame: (frames) => {
            box.dataset["frames"] = String(frames);
          },
          onFaces: (drawn, isCurrent) => {
            box.dataset["faces"] = String(drawn);
            box.dataset["drawn"] = String(isCurrent);
          },
          onFailure: (reason) =>
            app.shell.setState({ message: { title: strings.messages.notDrawn, lines: [reason] } }),
          onContextLost: () => setTrouble("context-lost"),
          onContextRestored: () => setTrouble(null),
        },
      });
    } catch {
      setTrouble("no-webgl");
      return undefined;
    }
    const stop = followSession(app, made);
    const tools = new ToolController(surface, made, new SelectTool(made, app.view, setHover), (target) =>
      pageApps.owns(app, target),
    );
    app.viewer.setState({ viewer: made });
    setViewer(made);
    return () => {
      stop();
      tools.dispose();
      app.viewer.setState({ viewer: null });
      setViewer(null);
      made.dispose();
    };
  }, [app]);
  useEffect(() => viewer?.setColors(viewerColors[scheme]), [viewer, scheme]);

  return (
    <main className={styles["view"]}>
      <ViewState container={container} />
      <div ref={container} className={styles["canvasBox"]} data-testid="viewport">
        <ViewCanvas canvas={canvas} viewer={viewer} />
        {viewer && <ProblemMarkers viewer={viewer} />}
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
  const cut = useView((state) => state.cut.enabled);
  const stale = useStale();
  const summary = [
    strings.viewport.label,
    ": ",
    describeMesh(project, mesh),
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
