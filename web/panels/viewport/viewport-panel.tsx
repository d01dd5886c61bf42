import { lazy, Suspense, useEffect, useLayoutEffect, useRef, useState } from "react";
import { useStore } from "zustand";
import type { Hover } from "../../tools/select-tool";
import type { Viewer } from "../../viewer/viewer";
import { useApp, useShell, useView } from "../shared/app-context";
import { ContextMenu, SelectionOutline } from "./selection-overlays";
import { DrawingBar } from "./drawing-bar";
import { DrawingMarks } from "./drawing-marks";
import { HoverLabel } from "./hover-label";
import { Legend } from "./legend";
import { PatchRoleLabels } from "./patch-role-labels";
import { PointNumbers } from "./point-numbers";
import { PositionMarker, ProblemMarkers } from "./problem-markers";
import { CornerNotes, CutBar, MeshBadge, MouseHint, ViewNotice } from "./viewport-overlays";
import type { Layout } from "../shared/use-layout";
import { SizeBar } from "./size-bar";
import { ToolColumn } from "./tool-column";
import { OperationPanel } from "../operations/operation-panel";
import { useViewer } from "./use-viewer";
import { ViewCanvas } from "./view-canvas";
import { VolumeChoices } from "../../teach/panels/player/volume-choices";
import { ViewState } from "./view-state";
import { useShowsPlane } from "../../teach/panels/player/use-player";
import styles from "./viewport-panel.module.css";

const importLabels = () => import("../../teach/panels/player/lens-labels");
const LensLabels = lazy(async () => ({ default: (await importLabels()).LensLabels }));
const importPlane = () => import("../../teach/panels/player/plane-view");
const PlaneView = lazy(async () => ({ default: (await importPlane()).PlaneView }));

const Notices = lazy(async () => ({ default: (await import("../dialogs/notices")).Notices }));
const StartPage = lazy(() => import("../files/start-page"));

/** Width that the column of tools covers, in CSS pixels. */
const columnWidth = 58;
/** Space to the right of the panel of an operation, in CSS pixels. On phones, the panel is below the view. */
const operationMargin = 8;

/** The canvas with the labels, markers and controls above it. */
export function ViewportPanel({ layout }: { readonly layout: Layout }) {
  const container = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const [hover, setHover] = useState<Hover | null>(null);
  const hasChoices = useView((state) => state.tool !== "select");
  const showsSizes = useView((state) => state.sizes.enabled);
  const app = useApp();
  const isReplaying = useStore(app.player.state, ({ trace }) => trace !== null);
  const isMoving = useStore(app.drawing.state, ({ amount, typed }) => amount !== null || typed !== null);
  const showsPlane = useShowsPlane();
  const isLessonModel = useLessonModel();
  const hasColumn = !isLessonModel && (layout !== "phone" || !isReplaying);
  const hasOperation = useStore(app.operations.state, ({ open }) => open !== null);
  const [operation, setOperation] = useState<HTMLElement | null>(null);
  const showsStart = useShell(({ startPage }) => startPage) && !hasOperation && !isReplaying;
  const [start, setStart] = useState<HTMLElement | null>(null);
  const operationEdge = useRightEdge(layout === "phone" ? null : (operation ?? start));
  const covered = operationEdge > 0 ? operationEdge + operationMargin : hasColumn ? columnWidth : 0;
  const { viewer, trouble } = useViewer(container, canvas, setHover, covered);
  useFitBeside(viewer, showsPlane);
  useEffect(() => {
    // So that the plane of a patch is there when one is first shown. The labels are needed before.
    if (isReplaying) void importLabels().then(importPlane);
  }, [isReplaying]);
  return (
    <main
      className={styles["view"]}
      data-operation={hasOperation || undefined}
      data-split={showsPlane || undefined}
      data-without-tools={isLessonModel || undefined}
      data-start={showsStart || undefined}
      data-replaying={isReplaying || undefined}
    >
      <ViewState container={container} />
      <div ref={container} className={styles["canvasBox"]} data-testid="viewport">
        <ViewCanvas canvas={canvas} viewer={viewer} />
        {viewer && <ProblemMarkers viewer={viewer} />}
        {viewer && <PositionMarker viewer={viewer} />}
        {viewer && <PatchRoleLabels viewer={viewer} />}
        {viewer && <PointNumbers viewer={viewer} />}
        {hover && !isMoving && <HoverLabel hover={hover} />}
        {viewer && <VolumeChoices viewer={viewer} />}
        {viewer && isReplaying && (
          <Suspense fallback={null}>
            <LensLabels viewer={viewer} />
          </Suspense>
        )}
        {viewer && <DrawingMarks viewer={viewer} />}
        <SelectionOutline />
      </div>
      {showsPlane && (
        <Suspense fallback={null}>
          <PlaneView />
        </Suspense>
      )}
      {trouble && <ViewNotice trouble={trouble} />}
      {!isLessonModel && <ToolColumn />}
      <div className={styles["top"]}>
        {hasChoices ? <DrawingBar /> : showsSizes ? <SizeBar /> : <CutBar />}
        {/* On a wide screen, the panel of an operation takes this place. */}
        {!hasOperation && <MeshBadge />}
      </div>
      <CornerNotes />
      <ContextMenu />
      {!trouble && <Legend />}
      {layout !== "phone" && !showsPlane && <MouseHint />}
      <OperationPanel ref={setOperation} />
      {layout === "wide" && (
        <Suspense fallback={null}>
          <Notices />
        </Suspense>
      )}
      {showsStart && (
        <Suspense fallback={null}>
          <StartPage ref={setStart} />
        </Suspense>
      )}
    </main>
  );
}

/** Returns whether the model of the open lesson is shown, which is not edited. */
function useLessonModel(): boolean {
  const app = useApp();
  const id = useStore(app.documents.state, (state) => state.id);
  return useStore(app.shell, ({ lesson, lessonModel }) => lesson !== null && lessonModel === id);
}

/** Returns where an element ends in what contains it, in CSS pixels from the left; 0 without one. */
function useRightEdge(element: HTMLElement | null): number {
  const [edge, setEdge] = useState(0);
  useLayoutEffect(() => {
    if (!element) return;
    const measure = (): void => {
      const left = element.offsetParent?.getBoundingClientRect().left ?? 0;
      setEdge(element.getBoundingClientRect().right - left);
    };
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, [element]);
  return element ? edge : 0;
}

/** Fits the model to the view again when the plane of a patch takes half of its width, or gives it back. */
function useFitBeside(viewer: Viewer | null, showsPlane: boolean): void {
  const { player } = useApp();
  const before = useRef(showsPlane);
  useEffect(() => {
    if (before.current === showsPlane) return;
    before.current = showsPlane;
    // The view is at the base edge.
    if (player.state.getState().follows) return;
    // The canvas gets its new size in the next frame.
    let frame = requestAnimationFrame(() => {
      frame = requestAnimationFrame(() => viewer?.framing.fit(null));
    });
    return () => cancelAnimationFrame(frame);
  }, [viewer, player, showsPlane]);
}
