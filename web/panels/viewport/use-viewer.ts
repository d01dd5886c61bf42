import { useComputedColorScheme } from "@mantine/core";
import { useEffect, useLayoutEffect, useRef, useState, type RefObject } from "react";
import type { App } from "../../app/app";
import type { ViewState } from "../../document/selection";
import { showNote } from "../../commands/messages";
import { commandOfKey, runCommand } from "../../commands/registry";
import { editSelected } from "../../commands/selection-actions";
import { bodyForPatch, type Entity } from "../../document/entities";
import { isDrawingTool, type ToolName } from "../../document/tools";
import { projectNumbers } from "../../document/length-units";
import { BrushTool } from "../../tools/brush-tool";
import { DragTool, holdAll, holdPoints } from "../../tools/drag-tool";
import { LineTool } from "../../tools/drawing/line-tool";
import { MeasureTool } from "../../tools/drawing/measure-tool";
import { NodeTool } from "../../tools/drawing/node-tool";
import { PatchTool } from "../../tools/drawing/patch-tool";
import { PointTool } from "../../tools/drawing/point-tool";
import { SourceTool } from "../../tools/drawing/source-tool";
import { TypedKeys } from "../../tools/drawing/typed-keys";
import { followPointer } from "../../tools/follow-pointer";
import { HandleTool } from "../../tools/handle-tool";
import type { Interaction } from "../../tools/interaction";
import { MoveKeys } from "../../tools/move-keys";
import { Motion } from "../../tools/motion";
import { TransformTool } from "../../tools/transform-tool";
import { SelectTool, type Hover } from "../../tools/select-tool";
import { ToolController } from "../../tools/tool-controller";
import { viewerColors } from "../../ui/theme/theme";
import type { ProjectBody } from "tetrafront/project";
import { placed } from "../../document/placement";
import type { Position } from "../../document/position";
import { strings } from "../../strings";
import { followSession, shownState } from "../../viewer/follow-session";
import { shownBodies } from "../../viewer/shown-bodies";
import { Viewer, type ViewerEvents } from "../../viewer/viewer";
import { useApp } from "../shared/app-context";

/** Why the view shows nothing. */
export type Trouble = "no-webgl" | "context-lost";

export interface UsedViewer {
  /** Null before the first picture, and without WebGL. */
  readonly viewer: Viewer | null;
  readonly trouble: Trouble | null;
}

/** Draws the app in a canvas, and lets the pointer select in it. `onHover` must not change; `coveredLeft` is in CSS pixels. */
export function useViewer(
  container: RefObject<HTMLElement | null>,
  canvas: RefObject<HTMLCanvasElement | null>,
  onHover: (hover: Hover | null) => void,
  coveredLeft = 0,
): UsedViewer {
  const app = useApp();
  const covered = useRef(coveredLeft);
  const [viewer, setViewer] = useState<Viewer | null>(null);
  useLayoutEffect(() => {
    covered.current = coveredLeft;
    viewer?.setCoveredLeft(coveredLeft);
  }, [viewer, coveredLeft]);
  const [trouble, setTrouble] = useState<Trouble | null>(null);
  const scheme = useComputedColorScheme("dark", { getInitialValueInEffect: false });
  const firstColors = useRef(viewerColors[scheme]);
  useEffect(() => {
    const [box, surface] = [container.current, canvas.current];
    if (!box || !surface) return undefined;
    let made: Viewer;
    try {
      made = new Viewer(box, surface, {
        state: shownState(app),
        colors: firstColors.current,
        motion: !app.still && !window.matchMedia("(prefers-reduced-motion: reduce)").matches,
        smoothEdges: !app.still,
        adaptiveResolution: !app.still,
        coveredLeft: covered.current,
        meshQueries: app.meshQueries,
        events: viewerEvents(app, box, setTrouble),
      });
    } catch {
      setTrouble("no-webgl");
      return undefined;
    }
    const disconnect = connect(app, made, surface, onHover);
    setViewer(made);
    return () => {
      disconnect();
      setViewer(null);
      made.dispose();
    };
  }, [app, container, canvas, onHover]);
  useEffect(() => viewer?.setColors(viewerColors[scheme]), [viewer, scheme]);
  return { viewer, trouble };
}

/** Copies the progress of drawing to attributes of the element around the canvas, for tests, and reports failures. */
function viewerEvents(
  app: App,
  { dataset }: HTMLElement,
  setTrouble: (trouble: Trouble | null) => void,
): ViewerEvents {
  return {
    onFrame: (frames) => {
      dataset["frames"] = String(frames);
    },
    onFaces: (drawn, isCurrent) => {
      dataset["faces"] = String(drawn);
      dataset["drawn"] = String(isCurrent);
    },
    onFailure: (reason) =>
      app.shell.setState({ message: { title: strings.messages.notDrawn, lines: [reason] } }),
    onContextLost: () => setTrouble("context-lost"),
    onContextRestored: () => setTrouble(null),
  };
}

/** Returns a function that finds the middle of the triangles of a body where it is placed. */
const bodyCentres =
  ({ bodies }: App) =>
  ({ id, placement }: ProjectBody): Position | null => {
    const centre = bodies.state.getState().byId.get(id)?.loaded?.drawn.centre;
    return centre ? placed(centre, placement) : null;
  };

/** Makes the receiver of keys that may begin coordinates or be hotkeys. */
const typedKeys = (app: App): TypedKeys =>
  new TypedKeys({
    drawing: app.drawing,
    named: () => projectNumbers(app.documents.project),
    hotkeyOf: (key) => {
      const command = commandOfKey(key);
      if (!command?.enabled(app)) return null;
      return { label: command.label(app), run: () => runCommand(app, command) };
    },
  });

/** Connects a viewer with its app: what it shows, and what the pointer does in it. Returns a function that ends this. */
function connect(
  app: App,
  viewer: Viewer,
  canvas: HTMLCanvasElement,
  onHover: (hover: Hover | null) => void,
): () => void {
  const stop = followSession(app, viewer);
  const { documents, operations, previews, view, drawing } = app;
  const tools = new ToolController(canvas, viewer);
  const brush = new BrushTool(app.documents, app.view, viewer);
  const keys = typedKeys(app);
  const inform = (text: string): void => showNote(app, text);
  const motion = new Motion({ documents, view, drawing, keys, viewer, inform });
  const stores = {
    documents,
    operations,
    previews,
    view,
    drawing,
    viewer,
    keys,
    motion,
    inform,
    centreOf: bodyCentres(app),
  };
  const selecting = { ...stores, bodies: () => shownBodies(documents.project, app.bodies) };
  const selectEvents = { onHover, onEdit: () => editSelected(app, "values") };
  const select = new SelectTool(viewer, selecting, selectEvents);
  const meant = (entity: Entity): Entity => bodyForPatch(documents.project, entity);
  const selectMovable = new SelectTool(viewer, { ...selecting, meant }, selectEvents);
  const handles = new HandleTool(stores);
  const byName: Readonly<Record<ToolName, readonly Interaction[]>> = {
    select: [handles, new DragTool(stores, holdPoints), select],
    move: [
      handles,
      new TransformTool(stores),
      new DragTool(stores, holdAll),
      new MoveKeys(stores),
      selectMovable,
    ],
    point: [new PointTool(stores)],
    line: [new LineTool(stores)],
    patch: [new PatchTool(stores)],
    node: [new NodeTool(stores)],
    source: [new SourceTool(stores)],
    measure: [new MeasureTool(stores)],
  };
  const show = ({ brush: hasBrush, moving, tool }: ViewState): void => {
    if (moving) tools.use([new TransformTool(stores, moving), select]);
    else tools.use(hasBrush ? [brush] : byName[tool]);
    canvas.style.cursor = hasBrush || isDrawingTool(tool) ? "crosshair" : "";
  };
  show(app.view.state.getState());
  const stopTools = app.view.state.subscribe((state, before) => {
    const isSame =
      state.tool === before.tool &&
      (state.brush === null) === (before.brush === null) &&
      state.moving === before.moving;
    if (!isSame) show(state);
  });
  // A motion by typed numbers may show several results before it is accepted.
  const hold = (): void =>
    viewer.framing.hold(tools.state.getState().hasGesture || drawing.state.getState().motion !== null);
  const stopsHolding = [tools.state.subscribe(hold), drawing.state.subscribe(hold)];
  const stopPointer = followPointer(canvas, stores);
  const stopReplay = app.replay.drawIn(viewer);
  app.viewer.setState({ viewer });
  return () => {
    keys.drop();
    stopReplay();
    stopPointer();
    for (const stopHolding of stopsHolding) stopHolding();
    stop();
    stopTools();
    tools.dispose();
    app.viewer.setState({ viewer: null });
  };
}
