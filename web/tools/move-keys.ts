import type { Position } from "../document/position";
import type { ViewStore } from "../document/selection";
import { translation } from "../document/transforms/affine";
import { offerTransform, transformStep } from "../document/transforms/transform";
import { fromFrame, scale, zero } from "../document/vectors";
import type { DocumentStore } from "../session/document-store";
import type { Viewer } from "../viewer/viewer";
import { gridStep } from "./drag-tool";
import type { Interaction } from "./interaction";

export interface MoveKeysStores {
  readonly documents: DocumentStore;
  readonly view: ViewStore;
  readonly viewer: Pick<Viewer, "pixelLength">;
}

/** Moves per arrow key, in the axes of the work plane. */
const directions: Readonly<Record<string, Position>> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowDown: [0, -1, 0],
  ArrowUp: [0, 1, 0],
  PageDown: [0, 0, -1],
  PageUp: [0, 0, 1],
};

/** Arrow keys move the selection by a step of the grid; Escape puts the tool away. */
export class MoveKeys implements Interaction {
  readonly #stores: MoveKeysStores;

  constructor(stores: MoveKeysStores) {
    this.#stores = stores;
  }

  key(event: KeyboardEvent): boolean {
    if (event.key === "Escape") {
      this.#stores.view.setTool("select");
      return true;
    }
    const direction = event.ctrlKey || event.metaKey ? undefined : directions[event.key];
    return direction !== undefined && this.#nudge(direction, event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
  }

  /** Returns false if nothing is selected: the keys then move the camera. */
  #nudge(direction: Position, steps: number): boolean {
    const { documents, view, viewer } = this.#stores;
    const { selection, workPlane } = view.state.getState();
    const offset = scale(direction, steps * gridStep(viewer));
    const map = translation(fromFrame({ ...workPlane.frame, origin: zero }, offset));
    const offer = offerTransform(documents.project, selection, map, {
      label: transformStep("move", selection),
      join: false,
    });
    if (offer.possible) documents.edit({ ...offer.creation.edit, mergeKey: "nudge" });
    return offer.possible;
  }
}
