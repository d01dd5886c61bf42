import type { Project, ProjectBody } from "tetrafront/project";
import { Group } from "three";
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
import { formatPosition } from "../ui/format";
import type { Layer } from "../viewer/layers/layer";
import type { SceneChanges, SceneState } from "../viewer/scene-state";
import type { ScreenPoint } from "../viewer/screen";
import type { Viewer } from "../viewer/viewer";
import type {
  HandleMotion,
  HandleSteps,
  NormalizedPointer,
  TransformHandles,
} from "./handles/transform-handles";
import type { Motion, MotionStart } from "./motion";
import type { Tool, ToolPointer } from "./tool";

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
 * one step of undo; Escape cancels it. Numbers may be typed instead. What coincides after the drag is joined. Passes
 * everything else to another tool. The code of the handles is loaded when they are first shown. If `moving` is given, the
 * handles are those of its body, whatever is selected; Escape hides them.
 */
export class TransformTool implements Tool {
  readonly id: string;
  readonly #stores: TransformStores;
  readonly #otherwise: Tool;
  readonly #moving: Moving | null;
  #handles: TransformHandles | null = null;
  /** What the handles are placed by. */
  #placed: Placed | null = null;
  /** Where a handle was pressed, and the middle of the selection then; null if none is. */
  #pressed: { readonly at: ScreenPoint; readonly middle: Position } | null = null;

  constructor(stores: TransformStores, otherwise: Tool, moving: Moving | null = null) {
    this.id = moving ? "move" : otherwise.id;
    this.#moving = moving;
    this.#stores = stores;
    this.#otherwise = otherwise;
  }

  down(pointer: ToolPointer): boolean {
    const at = this.#normalized(pointer.at);
    const handles = this.#handles;
    const isHandle = pointer.button === "left" && this.#isShown && handles?.hover(at) === true;
    // A press must not end the preview of an operation.
    const isFree = this.#stores.documents.state.getState().gestureStart === null;
    const start = isHandle && isFree ? this.#motion(true) : null;
    if (!start) return this.#otherwise.down(pointer);
    this.#pressed = { at: pointer.at, middle: start.base };
    this.#stores.motion.start({ ...start, axis: handles?.axis ?? null });
    handles?.press(at);
    return true;
  }

  move(pointer: ToolPointer | null): void {
    if (pointer && this.#pressed) {
      if (pointer.isDrag) this.#dragTo(pointer);
    } else {
      this.#otherwise.move(pointer && this.#isOverHandle(pointer) ? null : pointer);
    }
    if (this.#handles) this.#stores.viewer.requestFrame();
  }

  up(pointer: ToolPointer): void {
    if (!this.#pressed) return this.#otherwise.up(pointer);
    this.#pressed = null;
    this.#handles?.release(this.#normalized(pointer.at));
    // What was typed during the drag differs from where the pointer has left the handles.
    if (this.#placed) this.#place(this.#placed);
    this.#stores.motion.release();
  }

  cancel(): void {
    if (!this.#pressed) return this.#otherwise.cancel();
    this.#pressed = null;
    this.#handles?.release({ x: 0, y: 0 });
    this.#stores.motion.cancel();
  }

  /** Numbers and axes that are typed move the selection, also without a drag. */
  key(event: KeyboardEvent): boolean {
    if (this.#stores.motion.key(event, () => this.#motion(false))) return true;
    if (!this.#moving) return this.#otherwise.key(event);
    if (event.key !== "Escape") return false;
    this.#stores.view.setMoving(null);
    return true;
  }

  overlay(): Layer {
    return new TransformOverlay(this.#otherwise.overlay(), (root, isOver) => void this.#load(root, isOver), {
      place: (state) => this.#place(state),
      dispose: () => {
        this.#stores.motion.cancel();
        this.#handles?.dispose();
        this.#handles = null;
      },
    });
  }

  get #isShown(): boolean {
    return this.#handles?.root.visible === true;
  }

  /** Highlights the handle under a pointer without a pressed button: during another drag there are no handles. */
  #isOverHandle({ button, at }: ToolPointer): boolean {
    return button === null && this.#isShown && this.#handles?.hover(this.#normalized(at)) === true;
  }

  async #load(root: Group, isOver: () => boolean): Promise<void> {
    const { TransformHandles } = await import("./handles/transform-handles");
    if (isOver()) return;
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

/** The handles, with what the other tool draws. */
class TransformOverlay implements Layer {
  readonly root = new Group();
  readonly #other: Layer | null;
  readonly #events: { readonly place: (state: Placed) => void; readonly dispose: () => void };
  #isOver = false;

  constructor(
    other: Layer | null,
    load: (root: Group, isOver: () => boolean) => void,
    events: { readonly place: (state: Placed) => void; readonly dispose: () => void },
  ) {
    this.#other = other;
    this.#events = events;
    if (other) this.root.add(other.root);
    load(this.root, () => this.#isOver);
  }

  update(changes: SceneChanges): void {
    this.#other?.update(changes);
    if (changes.has("project", "selection", "origin", "handleMode", "bodies"))
      this.#events.place(changes.state);
  }

  dispose(): void {
    this.#isOver = true;
    this.#other?.dispose();
    this.#events.dispose();
  }
}
