import { Group } from "three";
import type { Layer } from "../viewer/layers/layer";
import type { SceneChanges } from "../viewer/scene-state";

export interface OverlayEvents {
  /** The scene has changed, after the layers were updated. */
  readonly onUpdate?: (changes: SceneChanges) => void;
  readonly onDispose: () => void;
}

/** What an interaction draws: several layers as one, and what it does when the scene changes. */
export class Overlay implements Layer {
  readonly root = new Group();
  readonly #layers: readonly Layer[];
  readonly #events: OverlayEvents;

  constructor(layers: readonly Layer[], events: OverlayEvents) {
    this.#layers = layers;
    this.#events = events;
    for (const layer of layers) this.root.add(layer.root);
  }

  update(changes: SceneChanges): void {
    for (const layer of this.#layers) layer.update(changes);
    this.#events.onUpdate?.(changes);
  }

  dispose(): void {
    for (const layer of this.#layers) layer.dispose();
    this.#events.onDispose();
  }
}
