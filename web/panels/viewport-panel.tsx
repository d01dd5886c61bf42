import { useComputedColorScheme } from "@mantine/core";
import { useEffect, useRef, useState, type KeyboardEvent } from "react";
import { useStore } from "zustand";
import { describeMesh } from "./mesh-summary";
import { isStale } from "../session/run";
import { faultsOf } from "../document/validate";
import { strings } from "../ui/strings";
import { viewerColors } from "../ui/theme";
import { Viewer } from "../viewer/viewer";
import type { App } from "../app/app";
import { useApp, useProject, useRun, useStale, useView } from "./app-context";
import { HoverLabel, type HoverPlace } from "./hover-label";
import { PatchMarks } from "./patch-marks";
import { ProblemMarkers } from "./problem-markers";
import { CutBar, Legend, MeshBadge, MouseHint, ViewNotice } from "./viewport-overlays";
import type { Layout } from "./use-layout";

type Trouble = "no-webgl" | "context-lost" | null;

/** Degrees per press of an arrow key, and the share of the distance panned. */
const turnStep = 10;
const shiftStep = 0.05;
const zoomStep = 1.15;

/** Hands every change of the stores on to the viewer. Returns the way to stop. */
function follow(app: App, viewer: Viewer): () => void {
  const { documents, previews, problems, run, view } = app;
  const showMesh = (): void => {
    viewer.setMesh(run.state.getState().mesh);
    showStale();
  };
  const showChecked = (): void =>
    viewer.setCheckedSurface(run.state.getState().outcome?.result.surface ?? null);
  const showStale = (): void => viewer.setStale(isStale(run.state.getState(), documents.project));
  const showFaults = (): void => viewer.setFaults(faultsOf(problems.state.getState().problems));
  viewer.setView(view.state.getState());
  viewer.setProject(documents.project, true);
  viewer.setPreview(previews.state.getState().preview, previews.state.getState().project);
  showMesh();
  showChecked();
  showFaults();
  const stops = [
    documents.onProject((project) => {
      viewer.setProject(project, false);
      showStale();
    }),
    previews.state.subscribe(({ preview, project }) => viewer.setPreview(preview, project)),
    view.state.subscribe((state) => viewer.setView(state)),
    run.state.subscribe((state, before) => {
      if (state.mesh !== before.mesh) showMesh();
      else if (state.meshKey !== before.meshKey) showStale();
      if (state.outcome !== before.outcome) showChecked();
    }),
    problems.state.subscribe(showFaults),
  ];
  return () => stops.forEach((stop) => stop());
}

/** The canvas and what floats above it. */
export function ViewportPanel({ layout }: { readonly layout: Layout }) {
  const app = useApp();
  const container = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const [viewer, setViewer] = useState<Viewer | null>(null);
  const [trouble, setTrouble] = useState<Trouble>(null);
  const [hover, setHover] = useState<HoverPlace | null>(null);
  const scheme = useComputedColorScheme("dark", { getInitialValueInEffect: false });
  const firstColors = useRef(viewerColors[scheme]);

  useEffect(() => {
    const box = container.current;
    const surface = canvas.current;
    if (!box || !surface) return undefined;
    let made: Viewer;
    try {
      made = new Viewer(box, surface, {
        colors: firstColors.current,
        motion: !app.still && !window.matchMedia("(prefers-reduced-motion: reduce)").matches,
        multisampling: !app.still,
        meshQueries: app.meshQueries,
        events: {
          onPick: ({ entity, element }, mode) => {
            if (element === null) app.view.select(entity, mode);
            else app.view.selectElement(element);
          },
          onHover: (entity, at) => {
            app.view.setHover(entity);
            setHover(entity && at ? { entity, ...at } : null);
          },
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
    const stop = follow(app, made);
    app.viewer.setState({ viewer: made });
    setViewer(made);
    return () => {
      stop();
      app.viewer.setState({ viewer: null });
      setViewer(null);
      made.dispose();
    };
  }, [app]);
  useEffect(() => viewer?.setColors(viewerColors[scheme]), [viewer, scheme]);

  return (
    <main className="tf-view">
      <ViewState container={container} />
      <div ref={container} className="tf-canvas-box" data-testid="viewport">
        <ViewCanvas canvas={canvas} viewer={viewer} />
        {viewer && <ProblemMarkers viewer={viewer} />}
        {viewer && <PatchMarks viewer={viewer} />}
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

/** The picture, with a summary in words and keys to move it. */
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
    if (!viewer || event.ctrlKey || event.metaKey || event.altKey) return;
    const move = (x: number, y: number) => () =>
      event.shiftKey ? viewer.shift(-x * shiftStep, -y * shiftStep) : viewer.turn(x * turnStep, y * turnStep);
    const moves: Readonly<Record<string, () => void>> = {
      ArrowLeft: move(-1, 0),
      ArrowRight: move(1, 0),
      ArrowUp: move(0, -1),
      ArrowDown: move(0, 1),
      "+": () => viewer.zoom(zoomStep),
      "=": () => viewer.zoom(zoomStep),
      "-": () => viewer.zoom(1 / zoomStep),
    };
    const act = moves[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  };
  return (
    <canvas
      ref={canvas}
      className="tf-canvas"
      data-testid="viewport-canvas"
      role="img"
      aria-label={summary}
      tabIndex={0}
      onKeyDown={onKeyDown}
    />
  );
}

/** Mirrors the state of the mesh onto the viewport element, where tests and styles can see it. */
function ViewState({ container }: { readonly container: React.RefObject<HTMLDivElement | null> }) {
  const mesh = useRun((state) => state.mesh);
  const busy = useRun((state) => state.busy);
  const front = useRun((state) => state.progress?.frontFaces ?? (state.mesh?.volume.front.length ?? 0) / 3);
  const app = useApp();
  const stale = useStale();
  const pending = useStore(app.autosave.state, (state) => state.pending);
  useEffect(() => {
    const data = container.current?.dataset;
    if (!data) return;
    data["tets"] = String(mesh?.report.tetrahedra ?? 0);
    data["status"] = mesh?.report.status ?? "none";
    data["fingerprint"] = mesh?.report.fingerprint ?? "";
    data["front"] = String(front);
    data["stale"] = String(stale);
    data["busy"] = String(busy);
    data["autosaved"] = String(!pending);
  }, [container, mesh, front, stale, busy, pending]);
  return null;
}
