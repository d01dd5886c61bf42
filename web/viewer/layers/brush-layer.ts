import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments } from "three";
import type { Position } from "../../document/position";
import type { SceneChanges } from "../scene-state";
import type { Layer } from "./layer";
import { appendReach } from "./source-shapes";

/** The reach of the brush around the pointer, drawn as that of a source. */
export class BrushLayer implements Layer {
  readonly root: LineSegments;
  readonly #material = new LineBasicMaterial({ transparent: true, depthTest: false });
  #origin: Position = [0, 0, 0];
  #centre: Position | null = null;

  constructor() {
    const ends: number[] = [];
    const centre: Position = [0, 0, 0];
    appendReach({ positions: [centre], distance: 1 }, centre, ends);
    const unit = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(ends, 3));
    this.root = new LineSegments(unit, this.#material);
    this.root.renderOrder = 7;
    this.root.frustumCulled = false;
    this.root.visible = false;
  }

  /** Shows the reach around a position in model coordinates, or hides it. */
  show(centre: Position | null, radius: number): void {
    this.#centre = centre;
    this.root.visible = centre !== null;
    this.root.scale.setScalar(radius);
    this.#place();
  }

  update(changes: SceneChanges): void {
    if (changes.has("colors")) this.#material.color.set(changes.state.colors.selection);
    this.#origin = changes.state.origin;
    this.#place();
  }

  dispose(): void {
    this.root.geometry.dispose();
    this.#material.dispose();
  }

  #place(): void {
    const [x, y, z] = this.#centre ?? this.#origin;
    this.root.position.set(x - this.#origin[0], y - this.#origin[1], z - this.#origin[2]);
  }
}
