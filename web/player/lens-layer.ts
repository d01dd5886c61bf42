import { Group } from "three";
import type { Position } from "../document/position";
import type { Layer } from "../viewer/layers/layer";
import type { SceneChanges } from "../viewer/scene-state";
import { drawnMarks, lensMarks, type DrawnMark } from "./lens-marks";
import { Dots, Facets, Segments, WideSegments } from "./lens-parts";
import type { LensScene } from "./lens-scene";
import { outlineOf } from "./search-region";

/** The search region of a step, and the marks of what the lens examines. They show through everything. */
export class LensLayer implements Layer {
  readonly root = new Group();
  readonly #region = new Segments("source");
  readonly #marks = drawnMarks.map((mark) => ({ mark, part: partOf(mark) }));
  readonly #parts = [this.#region, ...this.#marks.map(({ part }) => part)];
  #scene: LensScene | null = null;
  #origin: Position = [0, 0, 0];

  constructor() {
    this.root.visible = false;
    this.#parts.forEach(({ object }, order) => {
      object.frustumCulled = false;
      object.renderOrder = 20 + order;
      this.root.add(object);
    });
  }

  update(changes: SceneChanges): void {
    const { colors, origin, viewport } = changes.state;
    if (changes.has("colors")) for (const part of this.#parts) part.setColors(colors);
    if (changes.has("viewport"))
      for (const part of this.#parts)
        if (part instanceof WideSegments || part instanceof Dots) part.setViewport(viewport);
    if (!changes.has("origin")) return;
    this.#origin = origin;
    this.#draw();
  }

  show(scene: LensScene | null): void {
    if (scene === this.#scene) return;
    this.#scene = scene;
    this.#draw();
  }

  dispose(): void {
    for (const part of this.#parts) part.dispose();
  }

  #draw(): void {
    const scene = this.#scene;
    this.root.visible = scene !== null;
    if (!scene) return;
    const marks = lensMarks(scene);
    this.#region.set(scene.region ? outlineOf(scene.region) : [], this.#origin);
    for (const { mark, part } of this.#marks) part.set(mark.of(marks), this.#origin);
  }
}

function partOf(mark: DrawnMark): Facets | WideSegments | Dots {
  switch (mark.form) {
    case "faces":
      return new Facets(mark.color, mark.opacity);
    case "segments":
      return new WideSegments(mark.color, mark.width, false, mark.dash);
    case "dots":
      return new Dots(mark.color, mark.size);
  }
}
