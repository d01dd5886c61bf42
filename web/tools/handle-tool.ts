import type { Position } from "../document/position";
import type { ViewStore } from "../document/selection";
import { unit } from "../document/vectors";
import { onLine, onPlane, roundStep } from "../document/work-plane";
import type { DocumentStore } from "../session/document-store";
import type { Operations } from "../session/operations";
import type { Layer } from "../viewer/layers/layer";
import { SizeGlyphLayer } from "../viewer/layers/size-glyph-layer";
import type { Viewer } from "../viewer/viewer";
import type { Drawing } from "./drawing/drawing";
import type { Grip, GripDrag, Grips } from "./handles/grips";
import { operationGrips } from "./handles/operation-grips";
import { sizeGrips } from "./handles/size-handles";
import type { Interaction, ToolPointer } from "./interaction";
import { Overlay } from "./overlay";

export interface HandleStores {
  readonly documents: DocumentStore;
  readonly operations: Operations;
  readonly view: ViewStore;
  readonly drawing: Drawing;
  readonly viewer: Pick<Viewer, "seenFrom" | "pixelLength" | "requestFrame" | "onDrawn">;
}

/** How near the pointer must be to a handle, in CSS pixels. */
const reach = 10;
/** The handles are placed again if the view has been zoomed by this factor. */
const zoomStep = 1.15;
/** Smallest step of a coordinate or length, in CSS pixels. */
const stepPixels = 10;

interface Drag extends GripDrag {
  /** Returns where the pointer takes the grip; null for nowhere. */
  readonly target: (pointer: ToolPointer) => Position | null;
}

/**
 * Shows the size of a selected node or source as a glyph, with handles for size, stretching, direction and distance, or the
 * handles of the open operation. One drag of a handle is one step of undo, or changes a value of the operation; Escape
 * cancels it.
 */
export class HandleTool implements Interaction {
  readonly #stores: HandleStores;
  #layer: SizeGlyphLayer | null = null;
  #drag: Drag | null = null;
  #hovered: number | null = null;
  #isDescribed = false;
  /** As they are drawn. */
  #grips: Grips | null = null;
  /** Length of a pixel when they were placed. */
  #pixel = 0;

  constructor(stores: HandleStores) {
    this.#stores = stores;
  }

  down(pointer: ToolPointer): boolean {
    const isPlain = pointer.button === "left" && !pointer.shift && !pointer.mod;
    this.#drag = isPlain ? this.#begin(pointer) : null;
    if (!this.#drag) return false;
    // A finger presses without having been over the handle before.
    this.#hover(this.#indexAt(pointer));
    this.#describe(pointer);
    return true;
  }

  move(pointer: ToolPointer | null): boolean {
    if (!this.#drag) this.#hover(pointer && this.#indexAt(pointer));
    else if (pointer?.isDrag === true) this.#dragTo(pointer, this.#drag);
    this.#describe(pointer);
    return this.#hovered !== null;
  }

  up(pointer: ToolPointer): boolean {
    const drag = this.#drag;
    this.#drag = null;
    if (!drag) return false;
    if (pointer.isDrag) drag.commit();
    else drag.cancel();
    this.#hover(pointer.touch ? null : this.#indexAt(pointer));
    this.#describe(pointer);
    return true;
  }

  cancel(): void {
    this.#drag?.cancel();
    this.#drag = null;
    this.#hover(null);
    this.#describe(null);
  }

  overlay(): Layer {
    const layer = new SizeGlyphLayer();
    this.#layer = layer;
    const { viewer, operations } = this.#stores;
    const stops = [
      viewer.onDrawn(() => this.#followZoom()),
      operations.state.subscribe(() => {
        this.#show();
        viewer.requestFrame();
      }),
    ];
    return new Overlay([layer], {
      onUpdate: (changes) => {
        if (changes.has("project", "selection", "origin", "viewport")) this.#show();
      },
      onDispose: () => {
        for (const stop of stops) stop();
      },
    });
  }

  #indexAt(pointer: ToolPointer): number | null {
    const { toScreen } = this.#stores.viewer.seenFrom(pointer.at);
    let [nearest, least]: [number | null, number] = [null, reach];
    for (const [index, { position }] of (this.#grips?.grips ?? []).entries()) {
      const at = toScreen(position);
      const pixels = at ? Math.hypot(at.x - pointer.at.x, at.y - pointer.at.y) : Infinity;
      if (pixels < least) [nearest, least] = [index, pixels];
    }
    return nearest;
  }

  #begin(pointer: ToolPointer): Drag | null {
    const index = this.#indexAt(pointer);
    const grip = index === null ? undefined : this.#grips?.grips[index];
    const drag = index === null ? null : this.#grips?.begin(index);
    return grip && drag ? { ...drag, target: this.#targetOf(grip, pointer) } : null;
  }

  #targetOf({ position, moves }: Grip, { at }: ToolPointer): Drag["target"] {
    const { view, viewer } = this.#stores;
    if (typeof moves === "object")
      return (pointer) => onLine(viewer.seenFrom(pointer.at).ray, position, moves);
    const { frame } = view.state.getState().workPlane;
    const z = moves === "view" ? (unit(viewer.seenFrom(at).ray.direction) ?? frame.z) : frame.z;
    const plane = { ...frame, origin: position, z };
    return (pointer) => onPlane(viewer.seenFrom(pointer.at).ray, plane);
  }

  #dragTo(pointer: ToolPointer, drag: Drag): void {
    const to = drag.target(pointer);
    const { view, viewer } = this.#stores;
    const isFree = pointer.mod || !view.state.getState().snapping.grid;
    if (to) drag.moveTo(to, isFree ? 0 : roundStep(stepPixels * viewer.pixelLength));
  }

  #hover(index: number | null): void {
    if (index === this.#hovered) return;
    this.#hovered = index;
    this.#show();
    this.#stores.viewer.requestFrame();
  }

  /** Shows beside the pointer what the handle under it changes. */
  #describe(pointer: ToolPointer | null): void {
    const grip = this.#hovered === null ? undefined : this.#grips?.grips[this.#hovered];
    const { state } = this.#stores.drawing;
    if (grip && pointer) state.setState({ amount: grip.label, pointer: pointer.at });
    else if (this.#isDescribed) state.setState({ amount: null });
    this.#isDescribed = grip !== undefined && pointer !== null;
  }

  #followZoom(): void {
    const factor = this.#stores.viewer.pixelLength / this.#pixel;
    if (!this.#grips || this.#drag || (factor < zoomStep && factor > 1 / zoomStep)) return;
    this.#show();
    this.#stores.viewer.requestFrame();
  }

  #show(): void {
    const { documents, operations, view, viewer } = this.#stores;
    this.#pixel = viewer.pixelLength;
    const { selection } = view.state.getState();
    this.#grips = operationGrips(operations, this.#pixel) ?? sizeGrips(documents, selection, this.#pixel);
    const { glyphs, grips } = this.#grips ?? { glyphs: [], grips: [] };
    const hovered = this.#hovered === null ? undefined : grips[this.#hovered];
    if (!hovered) {
      this.#hovered = null;
      this.#describe(null);
    } else if (this.#isDescribed) this.#stores.drawing.state.setState({ amount: hovered.label });
    this.#layer?.show(
      this.#grips && {
        glyphs,
        handles: grips.map(({ position }) => position),
        stems: grips.flatMap(({ from, position }) => [from, position]),
        hovered: this.#hovered,
      },
    );
  }
}
