import { BufferAttribute, BufferGeometry, LineSegments } from "three";
import type { ViewerColors } from "../colors";
import { createGroundMaterial, setColor, setNumber } from "../materials";
import type { SceneLayer } from "./layer";

/** Half the number of lines each way. */
const lines = 20;

/** A level grid under the model: a sense of up, and of size. */
export class GroundLayer implements SceneLayer {
  readonly #material = createGroundMaterial();
  readonly root = new LineSegments(new BufferGeometry(), this.#material);

  constructor() {
    this.root.frustumCulled = false;
    this.root.renderOrder = -1;
  }

  setColors(colors: ViewerColors): void {
    setColor(this.#material, "color", colors.ground);
  }

  /** Lays the grid below a model of this radius around the origin, at a round spacing. */
  setExtent(radius: number, height: number): void {
    const rough = radius / 3;
    const power = 10 ** Math.floor(Math.log10(rough));
    const spacing = power * ([1, 2, 5, 10].find((step) => step * power >= rough) ?? 10);
    const reach = lines * spacing;
    const ends: number[] = [];
    for (let i = -lines; i <= lines; ++i) {
      // In pieces, because the fading is interpolated between the ends of a line.
      for (let j = -lines; j < lines; ++j) {
        ends.push(i * spacing, j * spacing, 0, i * spacing, (j + 1) * spacing, 0);
        ends.push(j * spacing, i * spacing, 0, (j + 1) * spacing, i * spacing, 0);
      }
    }
    this.root.geometry.dispose();
    this.root.geometry = new BufferGeometry().setAttribute(
      "position",
      new BufferAttribute(Float32Array.from(ends), 3),
    );
    this.root.position.set(0, 0, height);
    setNumber(this.#material, "reach", Math.min(reach, 9 * radius));
  }

  dispose(): void {
    this.root.geometry.dispose();
    this.#material.dispose();
  }
}
