import type { Trace } from "tetrafront/trace";
import { BufferAttribute, BufferGeometry, Group, Mesh, Sphere, Vector3, type Camera } from "three";
import type { Position } from "../../document/position";
import type { Layer } from "../../viewer/layers/layer";
import { setColor, setNumber } from "../../viewer/materials/uniforms";
import type { SceneChanges } from "../../viewer/scene-state";
import { nearFaces, type Neighbourhood } from "./near-faces";
import { createNearMaterials } from "./near-material";

/** The front near a step, which is shown instead of the whole front. */
export interface ShownNear extends Neighbourhood {
  /** State of the front. */
  readonly state: number;
  /** Faces of the state that are left out. */
  readonly leftOut: readonly number[];
}

/** Draws only the neighbourhood of a step; what hides the step is an outline. */
export class NearLayer implements Layer {
  readonly root = new Group();
  readonly #trace: Trace;
  #geometry = new BufferGeometry();
  readonly #materials = createNearMaterials();
  readonly #meshes = Object.values(this.#materials).map((material) => new Mesh(this.#geometry, material));
  #origin: Position = [0, 0, 0];
  #shown: ShownNear | null = null;

  constructor(trace: Trace) {
    this.#trace = trace;
    this.root.visible = false;
    this.#meshes.forEach((mesh, order) => {
      mesh.frustumCulled = false;
      mesh.renderOrder = 1 + order;
      mesh.onBeforeRender = (_renderer, _scene, camera) => this.#setCentre(camera);
      this.root.add(mesh);
    });
  }

  update(changes: SceneChanges): void {
    const { colors, origin } = changes.state;
    if (changes.has("colors")) {
      const { wall, outlines } = this.#materials;
      setColor(wall, "rim", colors.emptyRim);
      setColor(wall, "hollow", colors.emptyHollow);
      setColor(wall, "edgeColor", colors.meshEdge);
      setColor(outlines, "outline", colors.line);
    }
    if (!changes.has("origin")) return;
    this.#origin = origin;
    this.#draw();
  }

  /** Shows the front near a step; nothing for null. O(faces of the front) if the step is another one. */
  show(shown: ShownNear | null): void {
    const before = this.#shown;
    const isSame =
      shown?.state === before?.state &&
      shown?.leftOut === before?.leftOut &&
      shown?.radius === before?.radius &&
      shown?.centre.join() === before?.centre.join();
    if (isSame) return;
    this.#shown = shown;
    this.#draw();
  }

  dispose(): void {
    this.#geometry.dispose();
    for (const material of Object.values(this.#materials)) material.dispose();
  }

  #draw(): void {
    const shown = this.#shown;
    this.root.visible = shown !== null;
    if (!shown) return;
    this.#geometry.dispose();
    this.#geometry = new BufferGeometry();
    // For the order of drawing; three.js would look at all corners.
    this.#geometry.boundingSphere = new Sphere();
    const { positions, distances } = nearFaces(this.#trace, shown.state, shown, this.#origin, shown.leftOut);
    this.#geometry
      .setAttribute("position", new BufferAttribute(positions, 3))
      .setAttribute("away", new BufferAttribute(distances, 1));
    for (const mesh of this.#meshes) mesh.geometry = this.#geometry;
    for (const material of Object.values(this.#materials)) {
      setNumber(material, "radius", shown.radius);
      setNumber(material, "reach", shown.reach);
    }
  }

  /** The shaders compare with the centre as the camera sees it. */
  #setCentre({ matrixWorldInverse }: Camera): void {
    const shown = this.#shown;
    if (!shown) return;
    const [x, y, z] = this.#origin;
    scratch
      .set(shown.centre[0] - x, shown.centre[1] - y, shown.centre[2] - z)
      .applyMatrix4(matrixWorldInverse);
    for (const material of Object.values(this.#materials)) {
      const centre: unknown = material.uniforms["centre"]?.value;
      if (centre instanceof Vector3) centre.copy(scratch);
    }
  }
}

const scratch = new Vector3();
