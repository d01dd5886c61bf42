import type { Trace } from "tetrafront/trace";
import { BufferAttribute, BufferGeometry, Group, Mesh, Sphere, type DataTexture } from "three";
import type { Position } from "../../document/position";
import type { Layer } from "../../viewer/layers/layer";
import { rampTexture } from "../../viewer/materials/textures";
import { setColor, setTexture } from "../../viewer/materials/uniforms";
import type { SceneChanges } from "../../viewer/scene-state";
import { createFrontMaterial } from "./front-material";
import { poorAngle } from "./poor-angle";
import { SweepBuffers } from "./sweep-buffers";

/** The poor elements of the mesh after a sweep of the optimizer. */
export class SweepLayer implements Layer {
  readonly root = new Group();
  readonly #trace: Trace;
  readonly #material = createFrontMaterial({ opacity: 0.85 });
  readonly #mesh = new Mesh(new BufferGeometry(), this.#material);
  #ramp: DataTexture | null = null;
  #origin: Position = [0, 0, 0];
  #shown: number | null = null;

  constructor(trace: Trace) {
    this.#trace = trace;
    this.#mesh.frustumCulled = false;
    this.root.visible = false;
    this.root.add(this.#mesh);
    const range = this.#material.uniforms["range"];
    if (range) range.value = [0, poorAngle];
  }

  update(changes: SceneChanges): void {
    const { colors, origin } = changes.state;
    if (changes.has("colors")) {
      this.#ramp?.dispose();
      this.#ramp = rampTexture(colors.ramp);
      setTexture(this.#material, "ramp", this.#ramp);
      setColor(this.#material, "edgeColor", colors.meshEdge);
    }
    if (changes.has("origin")) {
      this.#origin = origin;
      this.#draw();
    }
  }

  /** Shows the mesh after a sweep, counted from 1; that of the front for 0; none for null. */
  show(sweep: number | null): void {
    if (sweep === this.#shown) return;
    this.#shown = sweep;
    this.#draw();
  }

  dispose(): void {
    this.#mesh.geometry.dispose();
    this.#material.dispose();
    this.#ramp?.dispose();
  }

  #draw(): void {
    const mesh = this.#shown === null ? undefined : this.#trace.optimization?.meshAfter(this.#shown);
    this.root.visible = mesh !== undefined;
    this.#mesh.geometry.dispose();
    this.#mesh.geometry = new BufferGeometry();
    // For the order of drawing; three.js would look at all corners.
    this.#mesh.geometry.boundingSphere = new Sphere();
    if (!mesh) return;
    const { positions, values } = new SweepBuffers(mesh, this.#origin);
    this.#mesh.geometry
      .setAttribute("position", new BufferAttribute(positions, 3))
      .setAttribute("value", new BufferAttribute(values, 1));
  }
}
