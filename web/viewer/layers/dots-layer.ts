import { BufferAttribute, BufferGeometry, Points } from "three";
import type { ViewerColors } from "../colors";
import { createDotMaterial, displayColor, setColor, setNumber } from "../materials";
import type { Position, SceneLayer } from "./layer";

/** How one dot is drawn. */
export type DotState = "normal" | "hover" | "selected" | "hidden";

/** Diameters on the screen in pixels; the material tells marked ones by it. */
const diameters: { readonly [S in DotState]: number } = { normal: 7, hover: 11, selected: 11, hidden: 0 };

/** Places drawn as dots: the model's points, or the nodes of the background grid. */
export class DotsLayer implements SceneLayer {
  readonly root: Points;
  readonly #material;
  readonly #color: (colors: ViewerColors) => string;
  #colors: ViewerColors | null = null;
  #states: readonly DotState[] = [];

  constructor(shape: "round" | "square", color: (colors: ViewerColors) => string) {
    this.#material = createDotMaterial(shape);
    this.#color = color;
    this.root = new Points(new BufferGeometry(), this.#material);
    this.root.frustumCulled = false;
    this.root.renderOrder = 5;
  }

  setColors(colors: ViewerColors): void {
    this.#colors = colors;
    setColor(this.#material, "rim", colors.faded);
    this.setStates(this.#states);
  }

  setPixelRatio(pixelRatio: number): void {
    setNumber(this.#material, "pixelRatio", pixelRatio);
  }

  setPlaces(places: readonly Position[], origin: Position): void {
    const position = new Float32Array(3 * places.length);
    places.forEach(([x, y, z], i) => {
      position[3 * i] = x - origin[0];
      position[3 * i + 1] = y - origin[1];
      position[3 * i + 2] = z - origin[2];
    });
    this.root.geometry.dispose();
    this.root.geometry = new BufferGeometry()
      .setAttribute("position", new BufferAttribute(position, 3))
      .setAttribute("tint", new BufferAttribute(new Float32Array(3 * places.length), 3))
      .setAttribute("diameter", new BufferAttribute(new Float32Array(places.length), 1));
  }

  /** One state per place, in the order of the places. */
  setStates(states: readonly DotState[]): void {
    this.#states = states;
    const colors = this.#colors;
    const tint = this.root.geometry.getAttribute("tint") as BufferAttribute | undefined;
    const diameter = this.root.geometry.getAttribute("diameter") as BufferAttribute | undefined;
    if (!colors || !tint || !diameter) return;
    const tints = {
      normal: displayColor(this.#color(colors)),
      hover: displayColor(colors.hover),
      selected: displayColor(colors.selection),
      hidden: displayColor(colors.faded),
    };
    const count = Math.min(states.length, diameter.count);
    for (let i = 0; i < count; ++i) {
      const state = states[i] ?? "hidden";
      const { r, g, b } = tints[state];
      tint.setXYZ(i, r, g, b);
      diameter.setX(i, diameters[state]);
    }
    tint.needsUpdate = true;
    diameter.needsUpdate = true;
  }

  dispose(): void {
    this.root.geometry.dispose();
    this.#material.dispose();
  }
}
