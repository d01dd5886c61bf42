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
import type { Position } from "../../document/position";
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
    const position = new BufferAttribute(relativeTo(origin, shownSizes.points), 3);
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

/** Returns x y z of each position relative to an origin. A plain loop: bodies have millions of positions. */
function relativeTo(origin: Position, points: Float64Array): Float32Array {
  const relative = new Float32Array(points.length);
  for (let i = 0; i < points.length; i += 3) {
    relative[i] = (points[i] ?? 0) - origin[0];
    relative[i + 1] = (points[i + 1] ?? 0) - origin[1];
    relative[i + 2] = (points[i + 2] ?? 0) - origin[2];
  }
  return relative;
}

/** Number of colours between the smallest size and the largest. */
const shades = 1024;

/** Returns r g b per position: the smallest size has the first colour, the largest the last, evenly by their ratio. */
export function sizeColors(
  { sizes, range: [low, high] }: Pick<ShownSizes, "sizes" | "range">,
  ramp: readonly string[],
): Float32Array {
  const table = shadesOf(ramp.map((color) => new Color(color)));
  const extent = Math.log(high / low);
  const rgb = new Float32Array(3 * sizes.length);
  for (let i = 0; i < sizes.length; ++i) {
    const share = extent > 0 ? Math.log((sizes[i] ?? low) / low) / extent : 0.5;
    const at = 3 * Math.round(Math.min(1, Math.max(0, share)) * shades);
    rgb[3 * i] = table[at] ?? 0;
    rgb[3 * i + 1] = table[at + 1] ?? 0;
    rgb[3 * i + 2] = table[at + 2] ?? 0;
  }
  return rgb;
}

/** Returns r g b of colours evenly spaced along a ramp, both ends included. */
function shadesOf(ramp: readonly Color[]): Float32Array {
  const table = new Float32Array(3 * (shades + 1));
  const mixed = new Color();
  for (let shade = 0; shade <= shades; ++shade) {
    const at = (shade / shades) * (ramp.length - 1);
    const [first, second] = [ramp[Math.floor(at)], ramp[Math.ceil(at)]];
    if (first && second) mixed.lerpColors(first, second, at - Math.floor(at)).toArray(table, 3 * shade);
  }
  return table;
}
