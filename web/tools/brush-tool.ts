import { addStroke, strokeLabel, type Brush } from "../document/brush";
import type { Position } from "../document/position";
import type { ViewStore } from "../document/selection";
import type { DocumentStore, Gesture } from "../session/document-store";
import { BrushLayer } from "../viewer/layers/brush-layer";
import type { Layer } from "../viewer/layers/layer";
import type { Viewer } from "../viewer/viewer";
import type { Tool, ToolPointer } from "./tool";

/** Distance between the positions of a stroke, as a share of the radius. */
const spacing = 0.5;

/**
 * Paints an element size on surfaces: a stroke of the left button becomes sources along it, one step of undo. Escape
 * cancels the stroke; without one, it puts the brush away. Circles at the pointer show how far the size applies.
 */
export class BrushTool implements Tool {
  readonly id = "brush";
  readonly #documents: DocumentStore;
  readonly #view: ViewStore;
  readonly #viewer: Pick<Viewer, "requestFrame">;
  #layer: BrushLayer | null = null;
  #stroke: readonly Position[] = [];
  #gesture: Gesture | null = null;

  constructor(documents: DocumentStore, view: ViewStore, viewer: Pick<Viewer, "requestFrame">) {
    this.#documents = documents;
    this.#view = view;
    this.#viewer = viewer;
  }

  down(pointer: ToolPointer): boolean {
    const hit = pointer.button === "left" ? pointer.hit() : null;
    if (!hit || !this.#brush) return false;
    this.#gesture = this.#documents.begin(strokeLabel);
    this.#paint(hit.position, this.#brush);
    return true;
  }

  move(pointer: ToolPointer | null): void {
    const brush = this.#brush;
    if (!brush) return;
    const position = pointer?.hit()?.position;
    this.#layer?.show(position ?? null, brush.radius);
    this.#viewer.requestFrame();
    if (!position || !this.#gesture) return;
    const last = this.#stroke.at(-1);
    const distance = last ? Math.hypot(...position.map((x, k) => x - (last[k] ?? 0))) : Infinity;
    if (distance >= spacing * brush.radius) this.#paint(position, brush);
  }

  up(): void {
    this.#gesture?.commit();
    this.#end();
  }

  cancel(): void {
    this.#gesture?.cancel();
    this.#end();
  }

  key(event: KeyboardEvent): boolean {
    if (event.key !== "Escape") return false;
    this.#view.setBrush(null);
    return true;
  }

  /** The reach of the brush at the pointer. */
  overlay(): Layer {
    this.#layer = new BrushLayer();
    return this.#layer;
  }

  get #brush(): Brush | null {
    return this.#view.state.getState().brush;
  }

  #paint(position: Position, brush: Brush): void {
    this.#stroke = [...this.#stroke, position];
    this.#gesture?.update(addStroke(this.#stroke, brush));
  }

  #end(): void {
    this.#gesture = null;
    this.#stroke = [];
  }
}
