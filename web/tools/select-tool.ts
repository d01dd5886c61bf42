import type { Entity } from "../document/entities";
import type { SelectMode, ViewStore } from "../document/selection";
import type { Layer } from "../viewer/layers/layer";
import type { ScreenPoint } from "../viewer/screen";
import type { Viewer } from "../viewer/viewer";
import type { Tool, ToolPointer } from "./tool";

/** An entity under the pointer. */
export interface Hover {
  readonly entity: Entity;
  readonly at: ScreenPoint;
}

/** Time that the pointer must rest before the entity under it is highlighted, in milliseconds. */
const hoverDelay = 80;

/**
 * A click selects, a double click fits the view to the entity, and a resting pointer highlights the entity
 * under it.
 */
export class SelectTool implements Tool {
  readonly id = "select";
  readonly #viewer: Pick<Viewer, "fitTarget">;
  readonly #view: ViewStore;
  readonly #onHover: (hover: Hover | null) => void;
  #restTimer: ReturnType<typeof setTimeout> | undefined;

  constructor(viewer: Pick<Viewer, "fitTarget">, view: ViewStore, onHover: (hover: Hover | null) => void) {
    this.#viewer = viewer;
    this.#view = view;
    this.#onHover = onHover;
  }

  down(): boolean {
    clearTimeout(this.#restTimer);
    return false;
  }

  move(pointer: ToolPointer | null): void {
    clearTimeout(this.#restTimer);
    if (pointer) this.#restTimer = setTimeout(() => this.#rest(pointer), hoverDelay);
    else this.#setHover(null);
  }

  up(pointer: ToolPointer): void {
    if (pointer.button !== "left") return;
    const target = pointer.hit()?.target ?? null;
    if (pointer.clicks === 2) this.#viewer.fitTarget(target);
    else if (target?.kind === "element") this.#view.selectElement(target.index);
    else this.#view.select(target, modeOf(pointer));
  }

  cancel(): void {
    clearTimeout(this.#restTimer);
  }

  key(): boolean {
    return false;
  }

  overlay(): Layer | null {
    return null;
  }

  #rest(pointer: ToolPointer): void {
    const target = pointer.hit()?.target;
    this.#setHover(target && target.kind !== "element" ? { entity: target, at: pointer.at } : null);
  }

  #setHover(hover: Hover | null): void {
    this.#view.setHover(hover?.entity ?? null);
    this.#onHover(hover);
  }
}

function modeOf({ mod, shift }: ToolPointer): SelectMode {
  if (mod) return "toggle";
  return shift ? "add" : "replace";
}
