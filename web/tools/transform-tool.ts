import { Group } from "three";
import type { Project } from "tetrafront";
import type { Entity } from "../document/entities";
import type { ViewStore } from "../document/selection";
import type { HandleMode } from "../document/tools";
import { translation, type Affine } from "../document/transforms/affine";
import { middleOf } from "../document/transforms/middle";
import { hasParts, selectedParts } from "../document/transforms/selected-parts";
import { offerTransform } from "../document/transforms/transform";
import { roundStep } from "../document/work-plane";
import type { DocumentStore, Gesture } from "../session/document-store";
import { operationStrings, strings } from "../strings";
import { formatPosition } from "../ui/format";
import type { Layer } from "../viewer/layers/layer";
import type { SceneChanges, SceneState } from "../viewer/scene-state";
import type { ScreenPoint } from "../viewer/screen";
import type { Viewer } from "../viewer/viewer";
import type { Drawing } from "./drawing/drawing";
import type { HandleSteps, NormalizedPointer, TransformHandles } from "./handles/transform-handles";
import type { Tool, ToolPointer } from "./tool";

export interface TransformStores {
  readonly documents: DocumentStore;
  readonly view: ViewStore;
  readonly drawing: Drawing;
  readonly viewer: Pick<Viewer, "camera" | "size" | "pixelLength" | "requestFrame">;
}

/** Steps of a drag; Ctrl turns them off. */
const angleStep = 15;
const factorStep = 0.1;
const stepPixels = 10;

const steps: { readonly [M in HandleMode]: string } = {
  translate: operationStrings.transforms.move.step,
  rotate: operationStrings.transforms.rotate.step,
  scale: operationStrings.transforms.scale.step,
};

const { amounts } = strings.drawing;

interface Drag {
  readonly gesture: Gesture;
  readonly project: Project;
  readonly selection: readonly Entity[];
  readonly mode: HandleMode;
  map: Affine;
}

/**
 * Shows handles at the middle of the selection that move, rotate or scale it, with steps unless Ctrl is held. One drag is
 * one step of undo; Escape cancels it. What coincides after the drag is joined. Passes everything else to another tool.
 * The code of the handles is loaded when they are first shown.
 */
export class TransformTool implements Tool {
  readonly id: string;
  readonly #stores: TransformStores;
  readonly #otherwise: Tool;
  #handles: TransformHandles | null = null;
  /** What the handles are placed by. */
  #placed: Placed | null = null;
  #drag: Drag | null = null;

  constructor(stores: TransformStores, otherwise: Tool) {
    this.id = otherwise.id;
    this.#stores = stores;
    this.#otherwise = otherwise;
  }

  down(pointer: ToolPointer): boolean {
    const at = this.#normalized(pointer.at);
    const isHandle = pointer.button === "left" && this.#isShown && this.#handles?.hover(at) === true;
    const { documents, view } = this.#stores;
    // A press must not end the preview of an operation.
    const isFree = documents.state.getState().gestureStart === null;
    if (!isHandle || !isFree) return this.#otherwise.down(pointer);
    const { selection, handleMode } = view.state.getState();
    const { project } = documents;
    const gesture = documents.begin(steps[handleMode]);
    this.#drag = { gesture, project, selection, mode: handleMode, map: translation([0, 0, 0]) };
    this.#handles?.press(at);
    return true;
  }

  move(pointer: ToolPointer | null): void {
    if (pointer && this.#drag && this.#handles) {
      if (!pointer.isDrag) return;
      const { map, numbers } = this.#handles.drag(this.#normalized(pointer.at), this.#steps(pointer));
      this.#drag.map = map;
      this.#show(this.#drag, false);
      const amount = amounts[this.#drag.mode](formatPosition(numbers));
      this.#stores.drawing.state.setState({ pointer: pointer.at, amount });
    } else {
      this.#otherwise.move(pointer && this.#isOverHandle(pointer) ? null : pointer);
    }
    if (this.#handles) this.#stores.viewer.requestFrame();
  }

  up(pointer: ToolPointer): void {
    const drag = this.#drag;
    if (!drag) return this.#otherwise.up(pointer);
    this.#drag = null;
    this.#handles?.release(this.#normalized(pointer.at));
    if (pointer.isDrag && this.#show(drag, true)) drag.gesture.commit();
    else drag.gesture.cancel();
    this.#stores.drawing.state.setState({ amount: null, refused: null });
  }

  cancel(): void {
    const drag = this.#drag;
    if (!drag) return this.#otherwise.cancel();
    this.#drag = null;
    this.#handles?.release({ x: 0, y: 0 });
    drag.gesture.cancel();
    this.#stores.drawing.state.setState({ amount: null, refused: null });
  }

  key(event: KeyboardEvent): boolean {
    return this.#otherwise.key(event);
  }

  overlay(): Layer {
    return new TransformOverlay(this.#otherwise.overlay(), (root, isOver) => void this.#load(root, isOver), {
      place: (state) => this.#place(state),
      dispose: () => {
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
    const { project, selection, origin, handleMode } = placed;
    const handles = this.#handles;
    if (!handles || handles.isDragging) return;
    handles.root.visible = hasParts(selectedParts(project, selection));
    handles.setMode(handleMode);
    if (handles.root.visible) handles.place(middleOf(project, selection), origin);
  }

  #steps({ mod }: ToolPointer): HandleSteps {
    const { view, viewer } = this.#stores;
    if (mod || !view.state.getState().snapping.grid) return { length: 0, angle: 0, factor: 0 };
    return { length: roundStep(stepPixels * viewer.pixelLength), angle: angleStep, factor: factorStep };
  }

  /** Returns whether the drag so far is possible. */
  #show({ project, selection, gesture, mode, map }: Drag, join: boolean): boolean {
    const offer = offerTransform(project, selection, map, { label: steps[mode], join });
    if (offer.possible) gesture.update(offer.creation.edit);
    this.#refuse(offer.possible ? null : offer.reason);
    return offer.possible;
  }

  /** Says why the drag does nothing. */
  #refuse(refused: string | null): void {
    const { state } = this.#stores.drawing;
    if (state.getState().refused !== refused) state.setState({ refused });
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
    if (changes.has("project", "selection", "origin", "handleMode")) this.#events.place(changes.state);
  }

  dispose(): void {
    this.#isOver = true;
    this.#other?.dispose();
    this.#events.dispose();
  }
}
