import { addStroke, strokeLabel, type Brush, type StrokePosition } from "../document/brush";
import { bodyOfEntity } from "../document/entities";
import type { ViewStore } from "../document/selection";
import type { DocumentStore, Gesture } from "../session/document-store";
import { BrushLayer } from "../viewer/layers/brush-layer";
import type { Hit, Layer } from "../viewer/layers/layer";
import type { Viewer } from "../viewer/viewer";
import type { Interaction, ToolPointer } from "./interaction";

/** Distance between the positions of a stroke, as a share of the radius. */
const spacing = 0.5;

/**
 * Paints an element size on surfaces: a stroke of the left button becomes sources along it, one step of undo. Escape
 * cancels the stroke; without one, it puts the brush away. Circles at the pointer show how far the size applies.
 */
export class BrushTool implements Interaction {
  readonly #documents: DocumentStore;
  readonly #view: ViewStore;
  readonly #viewer: Pick<Viewer, "requestFrame">;
  #layer: BrushLayer | null = null;
  #stroke: readonly StrokePosition[] = [];
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
    this.#paint(hit, this.#brush);
    return true;
  }

  move(pointer: ToolPointer | null): boolean {
    const brush = this.#brush;
    if (!brush) return false;
    const hit = pointer?.hit();
    this.#layer?.show(hit?.position ?? null, brush.radius);
    this.#viewer.requestFrame();
    if (!hit || !this.#gesture) return hit !== undefined && hit !== null;
    const last = this.#stroke.at(-1)?.position;
    const distance = last ? Math.hypot(...hit.position.map((x, k) => x - (last[k] ?? 0))) : Infinity;
    if (distance >= spacing * brush.radius) this.#paint(hit, brush);
    return true;
  }

  up(): boolean {
    this.#gesture?.commit();
    this.#end();
    return true;
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

  #paint({ position, target }: Hit, brush: Brush): void {
    const body = target.kind === "element" ? null : bodyOfEntity(this.#documents.project, target);
    this.#stroke = [...this.#stroke, { position, body }];
    this.#gesture?.update(addStroke(this.#stroke, brush));
  }

  #end(): void {
    this.#gesture = null;
    this.#stroke = [];
  }
}
