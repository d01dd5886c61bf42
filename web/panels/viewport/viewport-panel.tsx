import { lazy, Suspense, useLayoutEffect, useRef, useState } from "react";
import { useStore } from "zustand";
import type { Hover } from "../../tools/select-tool";
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
import { useSlots } from "../shared/slots";
import { useViewer } from "./use-viewer";
import { ViewCanvas } from "./view-canvas";
import { ViewCube } from "./view-cube";
import { ViewState } from "./view-state";
import styles from "./viewport-panel.module.css";

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
  const isReplaying = useStore(app.replay.state, ({ isShown }) => isShown);
  const { Overlay, Beside, useBeside } = useSlots();
  const isMoving = useStore(app.drawing.state, ({ amount, typed }) => amount !== null || typed !== null);
  const hasColumn = layout !== "phone" || !isReplaying;
  const hasOperation = useStore(app.operations.state, ({ open }) => open !== null);
  const [operation, setOperation] = useState<HTMLElement | null>(null);
  const showsStart = useShell(({ startPage }) => startPage) && !hasOperation && !isReplaying;
  const [start, setStart] = useState<HTMLElement | null>(null);
  const operationEdge = useRightEdge(layout === "phone" ? null : (operation ?? start));
  const covered = operationEdge > 0 ? operationEdge + operationMargin : hasColumn ? columnWidth : 0;
  const { viewer, trouble } = useViewer(container, canvas, setHover, covered);
  const hasBeside = useBeside(viewer);
  return (
    <main
      className={styles["view"]}
      data-operation={hasOperation || undefined}
      data-split={hasBeside || undefined}
      data-start={showsStart || undefined}
      data-replaying={isReplaying || undefined}
    >
      <ViewState container={container} />
      <div ref={container} className={styles["canvasBox"]} data-testid="viewport">
        <ViewCanvas canvas={canvas} viewer={viewer} />
        {viewer && <ViewCube viewer={viewer} />}
        {viewer && <ProblemMarkers viewer={viewer} />}
        {viewer && <PositionMarker viewer={viewer} />}
        {viewer && <PatchRoleLabels viewer={viewer} />}
        {viewer && <PointNumbers viewer={viewer} />}
        {hover && !isMoving && <HoverLabel hover={hover} />}
        {viewer && isReplaying && <Overlay viewer={viewer} />}
        {viewer && <DrawingMarks viewer={viewer} />}
        <SelectionOutline />
      </div>
      {hasBeside && (
        <Suspense fallback={null}>
          <Beside />
        </Suspense>
      )}
      {trouble && <ViewNotice trouble={trouble} />}
      <ToolColumn />
      <div className={styles["top"]}>
        {hasChoices ? <DrawingBar /> : showsSizes ? <SizeBar /> : <CutBar />}
        {/* On a wide screen, the panel of an operation takes this place. */}
        {!hasOperation && <MeshBadge />}
      </div>
      <CornerNotes />
      <ContextMenu />
      {!trouble && <Legend />}
      {layout !== "phone" && !hasBeside && <MouseHint />}
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
