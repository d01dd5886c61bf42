import { Group, type DataTexture, type Ray } from "three";
import { setStateColors } from "../draw-state";
import { createBodyMaterial } from "../materials/body-material";
import { createPatchMaterial } from "../materials/patch-material";
import { paletteTexture, rampTexture } from "../materials/textures";
import { setColor, setNumber, setTexture } from "../materials/uniforms";
import type { ViewerColors } from "../colors";
import { drawsIsosurface, showsFaces, type SceneChanges, type SceneState } from "../scene-state";
import { drawnOf } from "../shown-bodies";
import type { Screen } from "../screen";
import { BodyObject, type BodyMaterials, type BuildTree } from "./body-object";
import type { Hit, HittableLayer } from "./layer";

/** Opacity of patches behind other surfaces. */
const opacityBehind = 0.16;

/**
 * The surfaces of bodies: the given triangles, or those of a preview. Where a mesh is shown, only emphasized patches; where
 * target sizes are shown, the bodies without sizes.
 */
export class BodiesLayer implements HittableLayer {
  readonly root = new Group();
  readonly #objects = new Map<number, BodyObject>();
  readonly #materials: BodyMaterials = {
    plain: createBodyMaterial(),
    deviation: createBodyMaterial(),
    patch: createBodyMaterial(),
    color: createBodyMaterial(),
    emphasized: createPatchMaterial({
      opacities: { hover: 0.35, selected: 0.5, defective: 0.8 },
      polygonOffset: -1,
    }),
    behind: createPatchMaterial({
      opacities: { selected: opacityBehind, defective: opacityBehind },
      depthTest: false,
    }),
  };
  readonly #buildTree: BuildTree;
  #ramp: DataTexture | null = null;
  #palette: DataTexture | null = null;

  /** @param buildTree builds trees for hit tests in a worker. */
  constructor(buildTree: BuildTree) {
    this.#buildTree = buildTree;
    setNumber(this.#materials.deviation, "shaded", 1);
    setNumber(this.#materials.patch, "shaded", 1);
    setNumber(this.#materials.color, "shaded", 1);
    setNumber(this.#materials.color, "isPacked", 1);
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    if (changes.has("colors")) this.#setColors(state.colors);
    for (const material of this.#bases) setNumber(material, "edges", state.edges ? 1 : 0);
    if (changes.has("bodies", "bodySurface", "origin")) this.#setBodies(state);
    const { layers, hidden, shownSizes } = state;
    const isOn = layers.bodies && !drawsIsosurface(state);
    const isSolid = shownSizes !== null || !showsFaces(state);
    for (const [id, object] of this.#objects) {
      const isReplaced = shownSizes?.bodies.includes(id) === true;
      object.show(state, isOn && !hidden.has(`body-${id}`) && !isReplaced, isSolid);
    }
  }

  hit(ray: Ray, screen: Screen): Hit | null {
    let nearest: Hit | null = null;
    for (const object of this.#objects.values()) {
      const hit = object.hit(ray, screen);
      if (hit && (!nearest || hit.depth < nearest.depth)) nearest = hit;
    }
    return nearest;
  }

  /** Draws more of large surfaces in the next frame. Returns whether there is more. */
  drawMore(): boolean {
    return [...this.#objects.values()].map((object) => object.drawMore()).includes(true);
  }

  dispose(): void {
    for (const object of this.#objects.values()) object.dispose();
    for (const material of Object.values(this.#materials) as { dispose: () => void }[]) material.dispose();
    this.#ramp?.dispose();
    this.#palette?.dispose();
  }

  get #bases() {
    const { plain, deviation, patch, color } = this.#materials;
    return [plain, deviation, patch, color];
  }

  #setColors(colors: ViewerColors): void {
    const { hover, selection: selected, front: defective } = colors;
    this.#ramp?.dispose();
    this.#palette?.dispose();
    this.#ramp = rampTexture(colors.ramp);
    this.#palette = paletteTexture(colors.regions);
    setTexture(this.#materials.deviation, "ramp", this.#ramp);
    for (const material of [this.#materials.patch, this.#materials.color]) {
      setTexture(material, "ramp", this.#palette);
      setNumber(material, "hues", colors.regions.length);
    }
    for (const material of this.#bases) {
      setColor(material, "plainColor", colors.meshPlain);
      setColor(material, "edgeColor", colors.meshEdge);
    }
    for (const material of [this.#materials.emphasized, this.#materials.behind]) {
      setStateColors(material, { hover, selected, defective });
    }
  }

  #setBodies({ bodies, bodySurface, origin }: SceneState): void {
    const ids = new Set(bodies.map(({ id }) => id));
    for (const [id, object] of this.#objects) {
      if (ids.has(id)) continue;
      this.root.remove(object.root);
      object.dispose();
      this.#objects.delete(id);
    }
    for (const body of bodies) {
      const object = this.#objects.get(body.id) ?? new BodyObject(this.#materials);
      if (!this.#objects.has(body.id)) this.root.add(object.root);
      this.#objects.set(body.id, object);
      object.setTriangles(drawnOf(body, bodySurface), this.#buildTree);
      object.place(origin);
    }
  }
}
