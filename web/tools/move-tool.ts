import type { BodyPlacement } from "tetrafront";
import { setPlacement } from "../document/body-edits";
import { findRecord } from "../document/entities";
import { combined, noRotation, placed } from "../document/placement";
import type { Position } from "../document/position";
import type { Moving, ViewStore } from "../document/selection";
import type { BodyFeed } from "../session/bodies";
import type { DocumentStore, Gesture } from "../session/document-store";
import type { Layer } from "../viewer/layers/layer";
import type { ScreenPoint } from "../viewer/screen";
import type { Viewer } from "../viewer/viewer";
import { MoveHandles, type HandleMotion } from "./move-handles";
import type { Tool, ToolPointer } from "./tool";

export interface MoveToolOptions {
  readonly viewer: Pick<Viewer, "camera" | "size" | "requestFrame">;
  readonly documents: DocumentStore;
  readonly bodies: BodyFeed;
  readonly view: ViewStore;
  /** Receives the presses beside the handles. */
  readonly otherwise: Tool;
}

/** A drag of a handle: the placement and the middle of the body when it began. */
interface Drag {
  readonly gesture: Gesture;
  readonly placement: BodyPlacement;
  readonly centre: Position;
}

/** Moves or rotates a body by handles: one drag is one step of undo. Escape cancels a drag, or hides the handles. */
export class MoveTool implements Tool {
  readonly id = "move";
  readonly #options: MoveToolOptions;
  readonly #body: number;
  readonly #handles: MoveHandles;
  #drag: Drag | null = null;

  constructor(options: MoveToolOptions, { body, mode }: Moving) {
    this.#options = options;
    this.#body = body;
    this.#handles = new MoveHandles(options.viewer.camera, body, (motion) => this.#move(motion));
    this.#handles.setMode(mode);
  }

  down(pointer: ToolPointer): boolean {
    const at = this.#normalized(pointer.at);
    const drag = pointer.button === "left" && this.#handles.hover(at) ? this.#begin() : null;
    if (!drag) return this.#options.otherwise.down(pointer);
    this.#drag = drag;
    this.#handles.press(at);
    return true;
  }

  move(pointer: ToolPointer | null): void {
    if (pointer && this.#drag) this.#handles.drag(this.#normalized(pointer.at));
    else {
      if (pointer) this.#handles.hover(this.#normalized(pointer.at));
      this.#options.otherwise.move(pointer);
    }
    this.#options.viewer.requestFrame();
  }

  up(pointer: ToolPointer): void {
    if (!this.#drag) return this.#options.otherwise.up(pointer);
    this.#handles.release(this.#normalized(pointer.at));
    this.#drag.gesture.commit();
    this.#drag = null;
  }

  cancel(): void {
    if (!this.#drag) return this.#options.otherwise.cancel();
    this.#handles.release({ x: 0, y: 0 });
    this.#drag.gesture.cancel();
    this.#drag = null;
  }

  key(event: KeyboardEvent): boolean {
    if (event.key !== "Escape") return false;
    this.#options.view.setMoving(null);
    return true;
  }

  overlay(): Layer | null {
    return this.#handles;
  }

  #begin(): Drag | null {
    const { documents, bodies } = this.#options;
    const body = findRecord(documents.project, "body", this.#body);
    const given = bodies.state.getState().byId.get(this.#body)?.loaded;
    if (!body || !given) return null;
    const { placement = {} } = body;
    const { label } = setPlacement(this.#body, placement);
    return { gesture: documents.begin(label), placement, centre: given.drawn.centre };
  }

  /** Moves the body's middle by the translation, and rotates the body about its middle. */
  #move({ translation, rotation }: HandleMotion): void {
    if (!this.#drag) return;
    const { gesture, placement, centre } = this.#drag;
    const { scale = 1, rotation: before = noRotation } = placement;
    const middle = placed(centre, placement);
    const turned = { scale, rotation: combined(rotation, before) };
    const offset = placed(centre, turned);
    const position = middle.map((x, k) => x + (translation[k] ?? 0) - (offset[k] ?? 0)) as [
      number,
      number,
      number,
    ];
    gesture.update(setPlacement(this.#body, { ...turned, position }));
  }

  #normalized({ x, y }: ScreenPoint) {
    const { width, height } = this.#options.viewer.size;
    return { x: (2 * x) / width - 1, y: 1 - (2 * y) / height };
  }
}
