import { Group } from "three";
import type { Position } from "../document/position";
import type { ViewStore } from "../document/selection";
import { subtract, unit, type Frame } from "../document/vectors";
import { onPlane, roundStep, roundTo } from "../document/work-plane";
import type { DocumentStore, Gesture } from "../session/document-store";
import type { Layer } from "../viewer/layers/layer";
import { SizeGlyphLayer, type Glyph } from "../viewer/layers/size-glyph-layer";
import type { SceneChanges } from "../viewer/scene-state";
import type { Viewer } from "../viewer/viewer";
import { draggedTo, handledOf, handlesOf, radiiOf, type Handle, type Handled } from "./handles/size-handles";
import type { Tool, ToolPointer } from "./tool";

export interface HandleStores {
  readonly documents: DocumentStore;
  readonly view: ViewStore;
  readonly viewer: Pick<Viewer, "seenFrom" | "pixelLength" | "requestFrame" | "onDrawn">;
}

/** How near the pointer must be to a handle, in CSS pixels. */
const reach = 10;
/** The handles are placed again if the view has been zoomed by this factor. */
const zoomStep = 1.15;
/** Smallest step of a corner of a source, in CSS pixels. */
const stepPixels = 10;

interface Drag {
  readonly handled: Handled;
  readonly handle: Handle;
  readonly gesture: Gesture;
  /** Parallel to the view, through the handle. */
  readonly plane: Frame;
}

/**
 * Shows the size of a selected node or source as a glyph, with handles for size, stretching, direction and distance. One
 * drag of a handle is one step of undo; Escape cancels it. Passes everything else to another tool.
 */
export class HandleTool implements Tool {
  readonly id: string;
  readonly #stores: HandleStores;
  readonly #otherwise: Tool;
  #layer: SizeGlyphLayer | null = null;
  #drag: Drag | null = null;
  #hovered: number | null = null;
  /** As they are drawn. */
  #handles: readonly Handle[] = [];
  /** Length of a pixel when they were placed. */
  #pixel = 0;

  constructor(stores: HandleStores, otherwise: Tool) {
    this.id = otherwise.id;
    this.#stores = stores;
    this.#otherwise = otherwise;
  }

  down(pointer: ToolPointer): boolean {
    const isPlain = pointer.button === "left" && !pointer.shift && !pointer.mod;
    this.#drag = isPlain ? this.#begin(pointer) : null;
    return this.#drag !== null || this.#otherwise.down(pointer);
  }

  move(pointer: ToolPointer | null): void {
    if (pointer && this.#drag) {
      if (pointer.isDrag) this.#dragTo(pointer, this.#drag);
      return;
    }
    this.#hover(pointer ? this.#indexAt(pointer) : null);
    this.#otherwise.move(pointer);
  }

  up(pointer: ToolPointer): void {
    const drag = this.#drag;
    this.#drag = null;
    if (!drag) return this.#otherwise.up(pointer);
    if (pointer.isDrag) drag.gesture.commit();
    else drag.gesture.cancel();
  }

  cancel(): void {
    this.#drag?.gesture.cancel();
    this.#drag = null;
    this.#otherwise.cancel();
  }

  key(event: KeyboardEvent): boolean {
    return this.#otherwise.key(event);
  }

  overlay(): Layer {
    const layer = new SizeGlyphLayer();
    this.#layer = layer;
    const stop = this.#stores.viewer.onDrawn(() => this.#followZoom());
    return new HandleOverlay(layer, this.#otherwise.overlay(), () => this.#show(), stop);
  }

  get #handled(): Handled | null {
    const { documents, view } = this.#stores;
    return handledOf(documents.project, view.state.getState().selection);
  }

  #indexAt(pointer: ToolPointer): number | null {
    const { toScreen } = this.#stores.viewer.seenFrom(pointer.at);
    let [nearest, least]: [number | null, number] = [null, reach];
    for (const [index, { position }] of this.#handles.entries()) {
      const at = toScreen(position);
      const pixels = at ? Math.hypot(at.x - pointer.at.x, at.y - pointer.at.y) : Infinity;
      if (pixels < least) [nearest, least] = [index, pixels];
    }
    return nearest;
  }

  #begin(pointer: ToolPointer): Drag | null {
    // A press must not end the preview of an operation.
    if (this.#stores.documents.state.getState().gestureStart !== null) return null;
    const index = this.#indexAt(pointer);
    const handled = this.#handled;
    const handle = index === null ? undefined : this.#handles[index];
    if (!handled || !handle) return null;
    const { documents, view, viewer } = this.#stores;
    const { direction } = viewer.seenFrom(pointer.at).ray;
    const frame = view.state.getState().workPlane.frame;
    const plane = { ...frame, origin: handle.position, z: unit(direction) ?? frame.z };
    const { label } = draggedTo(handled, handle, handle.position);
    return { handled, handle, plane, gesture: documents.begin(label) };
  }

  #dragTo(pointer: ToolPointer, { handled, handle, gesture, plane }: Drag): void {
    const to = onPlane(this.#stores.viewer.seenFrom(pointer.at).ray, plane);
    if (!to) return;
    const isCorner = typeof handle.role === "object";
    gesture.update(draggedTo(handled, handle, isCorner && !pointer.mod ? this.#onGrid(to, handle) : to));
  }

  /** Rounds the coordinates of a corner that have changed. */
  #onGrid(to: Position, { position }: Handle): Position {
    const step = roundStep(stepPixels * this.#stores.viewer.pixelLength);
    if (!this.#stores.view.state.getState().snapping.grid) return to;
    const moved = subtract(to, position);
    return to.map((x, k) => (Math.abs(moved[k] ?? 0) < step / 2 ? (position[k] ?? 0) : roundTo(x, step))) as [
      number,
      number,
      number,
    ];
  }

  #hover(index: number | null): void {
    if (index === this.#hovered) return;
    this.#hovered = index;
    this.#show();
    this.#stores.viewer.requestFrame();
  }

  #followZoom(): void {
    const factor = this.#stores.viewer.pixelLength / this.#pixel;
    if (this.#handles.length === 0 || this.#drag || (factor < zoomStep && factor > 1 / zoomStep)) return;
    this.#show();
    this.#stores.viewer.requestFrame();
  }

  #show(): void {
    const handled = this.#handled;
    this.#pixel = this.#stores.viewer.pixelLength;
    const handles = handled ? handlesOf(handled, this.#pixel) : [];
    this.#handles = handles;
    this.#layer?.show(
      handled && {
        glyphs: [glyphOf(handled)],
        handles: handles.map(({ position }) => position),
        stems: handles.flatMap(({ from, position }) => [from, position]),
        hovered: this.#hovered,
      },
    );
  }
}

/** Returns the ellipsoid of a node, or the sphere of the size of a source at its first corner. */
function glyphOf(handled: Handled): Glyph {
  if (handled.kind === "source") {
    const { positions, size } = handled.shape;
    const [centre = [0, 0, 0] as const] = positions;
    return { centre, axis: [0, 0, 1], across: size / 2, along: size / 2 };
  }
  const [across, along] = radiiOf(handled.shape);
  return { centre: handled.centre, axis: handled.shape.direction, across, along };
}

/** The glyphs, with what the other tool draws. Each change of the scene may concern them. */
class HandleOverlay implements Layer {
  /** The layer hides its own root while nothing has a glyph. */
  readonly root = new Group();
  readonly #layer: SizeGlyphLayer;
  readonly #other: Layer | null;
  readonly #show: () => void;
  readonly #stop: () => void;

  constructor(layer: SizeGlyphLayer, other: Layer | null, show: () => void, stop: () => void) {
    this.root.add(layer.root);
    this.#layer = layer;
    this.#other = other;
    this.#show = show;
    this.#stop = stop;
    if (other) this.root.add(other.root);
  }

  update(changes: SceneChanges): void {
    this.#layer.update(changes);
    this.#other?.update(changes);
    if (changes.has("project", "selection", "origin", "viewport")) this.#show();
  }

  dispose(): void {
    this.#stop();
    this.#layer.dispose();
    this.#other?.dispose();
  }
}
