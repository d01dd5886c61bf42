import { BufferAttribute, BufferGeometry, LineSegments } from "three";
import { isDrawingTool } from "../../document/tools";
import { roundStep } from "../../document/work-plane";
import { roomyBounds } from "../bounds";
import { createGroundMaterial } from "../materials/ground-material";
import { setColor, setNumber } from "../materials/uniforms";
import type { SceneChanges } from "../scene-state";
import type { Layer } from "./layer";

/** Half the number of lines in each direction. */
const lines = 20;
/** Gap between model and ground, as a share of the model's radius. */
const gap = 0.04;

/** A horizontal grid under the model, which shows the vertical direction and the scale. */
export class GroundLayer implements Layer {
  readonly #material = createGroundMaterial();
  readonly root = new LineSegments(new BufferGeometry(), this.#material);

  constructor() {
    this.root.frustumCulled = false;
    this.root.renderOrder = -1;
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    // The drawing tools show the grid of the work plane instead.
    this.root.visible = !isDrawingTool(state.tool);
    if (changes.has("colors")) setColor(this.#material, "color", state.colors.ground);
    // The origin is at the centre of the model; it moves when the model has changed much.
    if (!changes.has("origin")) return;
    const { radius, low, centre } = roomyBounds(state.project);
    this.#lay(radius, low[2] - centre[2] - radius * gap);
  }

  dispose(): void {
    this.root.geometry.dispose();
    this.#material.dispose();
  }

  /** Lays the grid below a model of this radius around the origin, at a round spacing. */
  #lay(radius: number, height: number): void {
    const spacing = groundSpacing(radius);
    const reach = Math.min(lines * spacing, 9 * radius);
    const ends: number[] = [];
    for (let i = -lines; i <= lines; ++i) {
      const offset = i * spacing;
      // To where they have faded.
      const half = Math.sqrt(Math.max(0, reach ** 2 - offset ** 2));
      // In pieces, because the fading is interpolated between the ends of a piece.
      const pieces = Math.ceil(half / (2 * spacing));
      for (let j = -pieces; j < pieces; ++j) {
        const [from, to] = [j, j + 1].map((end) => (end / pieces) * half) as [number, number];
        ends.push(offset, from, 0, offset, to, 0, from, offset, 0, to, offset, 0);
      }
    }
    this.root.geometry.dispose();
    this.root.geometry = new BufferGeometry().setAttribute(
      "position",
      new BufferAttribute(Float32Array.from(ends), 3),
    );
    this.root.position.set(0, 0, height);
    setNumber(this.#material, "reach", reach);
  }
}

/** Returns the distance between the lines of the ground under a model of a radius. */
export const groundSpacing = (radius: number): number => roundStep(radius / 3);
