import { Group } from "three";
import type { Position } from "../../document/position";
import type { Layer } from "../../viewer/layers/layer";
import type { SceneChanges } from "../../viewer/scene-state";
import { drawnMarks, drawnPointed, lensMarks, type DrawnMark, type PointedMarks } from "./lens-marks";
import { Dots, Facets, Segments, WideSegments } from "./lens-parts";
import type { LensScene } from "./lens-scene";
import { drawnRecovery, type RecoveryMarks } from "./recovery-marks";
import { outlineOf } from "./search-region";

/** The search region of a step, and the marks of what the lens examines. They show through everything. */
export class LensLayer implements Layer {
  readonly root = new Group();
  readonly #region = new Segments("source");
  readonly #marks = drawnMarks.map((mark) => ({ mark, part: partOf(mark) }));
  readonly #recovery = drawnRecovery.map((mark) => ({ mark, part: partOf(mark) }));
  readonly #pointed = drawnPointed.map((mark) => ({ mark, part: partOf(mark) }));
  readonly #parts = [
    this.#region,
    ...[...this.#marks, ...this.#recovery, ...this.#pointed].map(({ part }) => part),
  ];
  #shownPointed: PointedMarks | null = null;
  #scene: LensScene | null = null;
  #recovered: RecoveryMarks | null = null;
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

  /** Shows what the lens examines, or else what a step of recovery changes. */
  show(scene: LensScene | null, recovered: RecoveryMarks | null = null): void {
    if (scene === this.#scene && recovered === this.#recovered) return;
    this.#scene = scene;
    this.#recovered = recovered;
    this.#draw();
  }

  /** Highlights a candidate of the scene; none for null. */
  point(marks: PointedMarks | null): void {
    if (marks === this.#shownPointed) return;
    this.#shownPointed = marks;
    this.#drawPointed();
  }

  #drawPointed(): void {
    const marks = this.#shownPointed;
    for (const { mark, part } of this.#pointed) part.set(marks ? mark.of(marks) : [], this.#origin);
  }

  dispose(): void {
    for (const part of this.#parts) part.dispose();
  }

  #draw(): void {
    this.#drawPointed();
    const [scene, recovered] = [this.#scene, this.#recovered];
    this.root.visible = scene !== null || recovered !== null;
    if (!this.root.visible) return;
    const marks = scene && lensMarks(scene);
    this.#region.set(scene?.region ? outlineOf(scene.region) : [], this.#origin);
    for (const { mark, part } of this.#marks) part.set(marks ? mark.of(marks) : [], this.#origin);
    for (const { mark, part } of this.#recovery) part.set(recovered ? mark.of(recovered) : [], this.#origin);
  }
}

function partOf(mark: DrawnMark<never>): Facets | WideSegments | Dots {
  switch (mark.form) {
    case "faces":
      return new Facets(mark.color, mark.opacity);
    case "segments":
      return new WideSegments(mark.color, mark.width, false, mark.dash);
    case "dots":
      return new Dots(mark.color, mark.size);
  }
}
