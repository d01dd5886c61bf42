import type { Project, ProjectBody } from "tetrafront/project";
import type { Group } from "three";
import { findRecord, type Entity } from "../document/entities";
import type { Moving, ViewState, ViewStore } from "../document/selection";
import type { Position } from "../document/position";
import { translation } from "../document/transforms/affine";
import { middleOf } from "../document/transforms/middle";
import { hasParts, selectedParts } from "../document/transforms/selected-parts";
import { axisDirections, subtract } from "../document/vectors";
import { onLine, roundStep, roundTo } from "../document/work-plane";
import type { DocumentStore } from "../session/document-store";
import { strings } from "../strings";
import { formatPosition } from "../strings/format";
import type { Layer } from "../viewer/layers/layer";
import type { SceneState } from "../viewer/scene-state";
import type { ScreenPoint } from "../viewer/screen";
import type { Viewer } from "../viewer/viewer";
import type {
  HandleMotion,
  HandleSteps,
  NormalizedPointer,
  TransformHandles,
} from "./handles/transform-handles";
import type { Interaction, ToolPointer } from "./interaction";
import type { Motion, MotionStart } from "./motion";
import { Overlay } from "./overlay";

export interface TransformStores {
  readonly documents: DocumentStore;
  readonly view: ViewStore;
  readonly motion: Motion;
  /** Returns the middle of the triangles of a body where it is placed; null while they are not loaded. */
  readonly centreOf?: (body: ProjectBody) => Position | null;
  readonly viewer: Pick<Viewer, "camera" | "seenFrom" | "size" | "pixelLength" | "requestFrame">;
}

/** Steps of a drag; Ctrl turns them off. */
const angleStep = 15;
const factorStep = 0.1;
const stepPixels = 10;

const { amounts } = strings.drawing;

/** What the handles move, and how. */
type Subject = Pick<ViewState, "selection" | "handleMode">;

/**
 * Shows handles at the middle of the selection that move, rotate or scale it, with steps unless Ctrl is held. One drag is
 * one step of undo; Escape cancels it. Numbers may be typed instead. What coincides after the drag is joined.
 * The code of the handles is loaded when they are first shown. If `moving` is given, the
 * handles are those of its body, whatever is selected; Escape hides them.
 */
export class TransformTool implements Interaction {
  readonly #stores: TransformStores;
  readonly #moving: Moving | null;
  #handles: TransformHandles | null = null;
  /** What the handles are placed by. */
  #placed: Placed | null = null;
  /** Where a handle was pressed, and the middle of the selection then; null if none is. */
  #pressed: { readonly at: ScreenPoint; readonly middle: Position } | null = null;

  constructor(stores: TransformStores, moving: Moving | null = null) {
    this.#moving = moving;
    this.#stores = stores;
  }

  down(pointer: ToolPointer): boolean {
    const at = this.#normalized(pointer.at);
    const handles = this.#handles;
    const isHandle = pointer.button === "left" && this.#isShown && handles?.hover(at) === true;
    // A press must not end the preview of an operation.
    const isFree = this.#stores.documents.state.getState().gestureStart === null;
    const start = isHandle && isFree ? this.#motion(true) : null;
    if (!start) return false;
    this.#pressed = { at: pointer.at, middle: start.base };
    this.#stores.motion.start({ ...start, axis: handles?.axis ?? null });
    handles?.press(at);
    return true;
  }

  move(pointer: ToolPointer | null): boolean {
    const handles = this.#handles;
    if (!pointer || !handles) return false;
    if (this.#pressed && pointer.isDrag) this.#dragTo(pointer);
    this.#stores.viewer.requestFrame();
    return this.#pressed !== null || (this.#isShown && handles.hover(this.#normalized(pointer.at)));
  }

  up(pointer: ToolPointer): boolean {
    if (!this.#pressed) return false;
    this.#pressed = null;
    this.#handles?.release(this.#normalized(pointer.at));
    // What was typed during the drag differs from where the pointer has left the handles.
    if (this.#placed) this.#place(this.#placed);
    this.#stores.motion.release();
    return true;
  }

  cancel(): void {
    if (!this.#pressed) return;
    this.#pressed = null;
    this.#handles?.release({ x: 0, y: 0 });
    this.#stores.motion.cancel();
  }

  /** Numbers and axes that are typed move the selection, also without a drag. */
  key(event: KeyboardEvent): boolean {
    if (this.#stores.motion.key(event, () => this.#motion(false))) return true;
    if (!this.#moving || event.key !== "Escape") return false;
    this.#stores.view.setMoving(null);
    return true;
  }

  overlay(): Layer {
    const ended = new AbortController();
    const overlay = new Overlay([], {
      onUpdate: (changes) => {
        if (changes.has("project", "selection", "origin", "handleMode", "bodies")) this.#place(changes.state);
      },
      onDispose: () => {
        ended.abort();
        this.#stores.motion.cancel();
        this.#handles?.dispose();
        this.#handles = null;
      },
    });
    void this.#load(overlay.root, ended.signal);
    return overlay;
  }

  get #isShown(): boolean {
    return this.#handles?.root.visible === true;
  }

  async #load(root: Group, ended: AbortSignal): Promise<void> {
    const { TransformHandles } = await import("./handles/transform-handles");
    if (ended.aborted) return;
    this.#handles = new TransformHandles(this.#stores.viewer.camera);
    this.#handles.root.visible = false;
    root.add(this.#handles.root);
    if (this.#placed) this.#place(this.#placed);
    this.#stores.viewer.requestFrame();
  }

  #place(placed: Placed): void {
    this.#placed = placed;
    const { project, origin } = placed;
    const { selection, handleMode } = this.#subjectOf(placed);
    const handles = this.#handles;
    if (!handles || handles.isDragging) return;
    handles.root.visible = this.#isMovable(project, selection);
    handles.setMode(handleMode);
    if (handles.root.visible) handles.place(middleOf(project, selection, this.#stores.centreOf), origin);
  }

  #subjectOf({ selection, handleMode }: Subject): Subject {
    if (!this.#moving) return { selection, handleMode };
    const { body, mode } = this.#moving;
    return { selection: [{ kind: "body", id: body }], handleMode: mode };
  }

  /** Returns whether there is something to move. The handles of a body are at its middle, which must be known. */
  #isMovable(project: Project, selection: readonly Entity[]): boolean {
    if (!this.#moving) return hasParts(selectedParts(project, selection));
    const body = findRecord(project, "body", this.#moving.body);
    return body !== undefined && this.#stores.centreOf?.(body) != null;
  }

  #steps({ mod }: ToolPointer): HandleSteps {
    const { view, viewer } = this.#stores;
    if (mod || !view.state.getState().snapping.grid) return { length: 0, angle: 0, factor: 0 };
    return { length: roundStep(stepPixels * viewer.pixelLength), angle: angleStep, factor: factorStep };
  }

  /** Returns what moves the selection; null if nothing can be moved now. */
  #motion(isHeld: boolean): MotionStart | null {
    const { documents, view } = this.#stores;
    const { selection, handleMode: mode } = this.#subjectOf(view.state.getState());
    const { project } = documents;
    if (documents.state.getState().gestureStart !== null || !this.#isMovable(project, selection)) return null;
    const base = middleOf(project, selection, this.#stores.centreOf);
    return { mode, selection, base, axis: null, isHeld };
  }

  #dragTo(pointer: ToolPointer): void {
    const { motion, view } = this.#stores;
    const { handleMode } = this.#subjectOf(view.state.getState());
    const moved = this.#handles?.drag(this.#normalized(pointer.at), this.#steps(pointer));
    const { map, numbers } = this.#alongAxis(pointer) ?? moved ?? { map: null, numbers: [] };
    if (map) motion.drag(map, amounts[handleMode](formatPosition(numbers)), pointer.at);
  }

  /** Moves along the axis that a key has chosen, whatever the handle; null without one. */
  #alongAxis(pointer: ToolPointer): HandleMotion | null {
    const { motion, view, viewer } = this.#stores;
    const { handleMode } = this.#subjectOf(view.state.getState());
    if (motion.axis === null || !this.#pressed || handleMode !== "translate") return null;
    const { at: pressed, middle } = this.#pressed;
    const along = axisDirections[motion.axis];
    const from = onLine(viewer.seenFrom(pressed).ray, middle, along);
    const to = onLine(viewer.seenFrom(pointer.at).ray, middle, along);
    if (!from || !to) return null;
    const { length } = this.#steps(pointer);
    const numbers = subtract(to, from).map((x) => (length > 0 ? roundTo(x, length) : x));
    return { map: translation(numbers as [number, number, number]), numbers };
  }

  #normalized({ x, y }: ScreenPoint): NormalizedPointer {
    const { width, height } = this.#stores.viewer.size;
    return { x: (2 * x) / width - 1, y: 1 - (2 * y) / height };
  }
}

type Placed = Pick<SceneState, "project" | "selection" | "origin" | "handleMode">;
