import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
} from "three";
import type { ShownSizes } from "../../session/size-feed";
import type { SceneChanges } from "../scene-state";
import type { Layer } from "./layer";

const opacityBeforePlane = 0.35;

/** The model and a plane, coloured by the target size: small sizes are dark, as on the scale of the mesh's quality. */
export class SizesLayer implements Layer {
  readonly root = new Group();
  readonly #patchMaterial = new MeshBasicMaterial({
    vertexColors: true,
    side: DoubleSide,
    transparent: true,
  });
  readonly #planeMaterial = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide });
  readonly #lineMaterial = new LineBasicMaterial({ vertexColors: true });
  readonly #patches = new Mesh(new BufferGeometry(), this.#patchMaterial);
  readonly #plane = new Mesh(new BufferGeometry(), this.#planeMaterial);
  readonly #lines = new LineSegments(new BufferGeometry(), this.#lineMaterial);

  constructor() {
    for (const drawn of [this.#patches, this.#plane, this.#lines]) {
      drawn.frustumCulled = false;
      this.root.add(drawn);
    }
  }

  update(changes: SceneChanges): void {
    const { shownSizes, origin, colors } = changes.state;
    this.root.visible = shownSizes !== null;
    if (!shownSizes || !changes.has("shownSizes", "origin", "colors")) return;
    const local = Float32Array.from(shownSizes.points, (x, i) => x - (origin[i % 3] ?? 0));
    const position = new BufferAttribute(local, 3);
    const color = new BufferAttribute(sizeColors(shownSizes, colors.ramp), 3);
    // Patches let the plane be seen that lies behind them.
    const hasPlane = shownSizes.plane.length > 0;
    this.#patchMaterial.opacity = hasPlane ? opacityBeforePlane : 1;
    this.#patchMaterial.depthWrite = !hasPlane;
    for (const [drawn, indices] of [
      [this.#patches, shownSizes.triangles],
      [this.#plane, shownSizes.plane],
      [this.#lines, shownSizes.segments],
    ] as const) {
      drawn.geometry.dispose();
      drawn.geometry = new BufferGeometry()
        .setAttribute("position", position)
        .setAttribute("color", color)
        .setIndex(new BufferAttribute(indices, 1));
    }
  }

  dispose(): void {
    for (const { geometry, material } of [this.#patches, this.#plane, this.#lines]) {
      geometry.dispose();
      material.dispose();
    }
  }
}

/** Returns r g b per position: the smallest size has the first colour, the largest the last, evenly by their ratio. */
export function sizeColors(
  { sizes, range: [low, high] }: Pick<ShownSizes, "sizes" | "range">,
  ramp: readonly string[],
): Float32Array {
  const colors = ramp.map((color) => new Color(color));
  const [last, extent] = [colors.length - 1, Math.log(high / low)];
  const rgb = new Float32Array(3 * sizes.length);
  const mixed = new Color();
  sizes.forEach((size, i) => {
    const share = extent > 0 ? Math.log(size / low) / extent : 0.5;
    const at = Math.min(last, Math.max(0, share * last));
    const first = colors[Math.floor(at)];
    const second = colors[Math.ceil(at)];
    if (first && second) mixed.lerpColors(first, second, at - Math.floor(at)).toArray(rgb, 3 * i);
  });
  return rgb;
}
