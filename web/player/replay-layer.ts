import type { Trace } from "tetrafront";
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  FrontSide,
  Group,
  Mesh,
  Sphere,
  Vector2,
  Vector3,
  type Camera,
  type DataTexture,
} from "three";
import type { Position } from "../document/position";
import type { Layer } from "../viewer/layers/layer";
import { rampTexture } from "../viewer/materials/textures";
import { setColor, setNumber, setTexture } from "../viewer/materials/uniforms";
import type { SceneChanges } from "../viewer/scene-state";
import { ElementBuffers } from "./element-buffers";
import { FrontBuffers } from "./front-buffers";
import { createFrontMaterial } from "./front-material";
import { type FrontColoring, frontValues, type FrontValues } from "./front-values";
import type { FrontChange } from "./judge";
import type { PlayerState } from "./player";

/** The front of a trace after a step, and the elements made last. */
export class ReplayLayer implements Layer {
  readonly root = new Group();
  readonly #trace: Trace;
  readonly #front: FrontBuffers;
  readonly #elements: ElementBuffers;
  readonly #frontMaterial = createFrontMaterial({ opacity: 1 });
  readonly #elementMaterial = createFrontMaterial({ opacity: 0.85 });
  readonly #frontGeometry = new BufferGeometry();
  readonly #elementGeometry = new BufferGeometry();
  #ramp: DataTexture | null = null;
  #values: FrontValues;
  #coloring: FrontColoring = "age";
  #origin: Position = [0, 0, 0];

  constructor(trace: Trace) {
    this.#trace = trace;
    this.#front = new FrontBuffers(trace);
    this.#elements = new ElementBuffers(trace);
    this.#values = frontValues(trace, this.#coloring);
    this.#setPower();
    const { positions, values } = this.#front;
    this.#frontGeometry
      .setAttribute("position", new BufferAttribute(positions, 3))
      .setAttribute("value", new BufferAttribute(values, 1));
    this.#elementGeometry
      .setAttribute("position", new BufferAttribute(this.#elements.positions, 3))
      .setAttribute("value", new BufferAttribute(this.#elements.values, 1));
    const front = new Mesh(this.#frontGeometry, this.#frontMaterial);
    const elements = new Mesh(this.#elementGeometry, this.#elementMaterial);
    const bounds = sphereAround(trace.nodes.positions);
    for (const mesh of [front, elements]) {
      mesh.onBeforeRender = (_renderer, _scene, camera) => this.#setDepths(bounds, camera);
      mesh.frustumCulled = false;
      // For the order of drawing; three.js would look at all corners.
      mesh.geometry.boundingSphere = new Sphere();
    }
    this.root.add(front, elements);
  }

  update(changes: SceneChanges): void {
    const { colors, origin } = changes.state;
    if (changes.has("colors")) {
      this.#ramp?.dispose();
      this.#ramp = rampTexture(colors.ramp);
      for (const material of [this.#frontMaterial, this.#elementMaterial]) {
        setTexture(material, "ramp", this.#ramp);
        setColor(material, "edgeColor", colors.meshEdge);
        setColor(material, "plain", colors.meshPlain);
        setColor(material, "background", colors.faded);
      }
    }
    if (changes.has("origin")) this.#reset(origin);
  }

  /**
   * Shows a state of the player; nothing before the volume. The cost of a few steps is that of their faces. `isFaded`: the
   * front stays behind what the lens shows. `supposed`: instead of what the step has made, the state before it is shown,
   * without the faces that would leave the front.
   */
  show(
    { step: after, sweep, coloring, faces, elements }: PlayerState,
    isFaded: boolean,
    supposed: FrontChange | null = null,
  ): void {
    this.root.visible = after >= 0 && sweep === null;
    if (after < 0) return;
    const step = supposed ? after - 1 : after;
    if (coloring !== this.#coloring) {
      this.#coloring = coloring;
      this.#values = frontValues(this.#trace, coloring);
      this.#setPower();
      this.#reset(this.#origin);
    }
    for (const material of [this.#frontMaterial, this.#elementMaterial])
      setNumber(material, "fading", isFaded ? 1 : 0);
    this.#frontMaterial.side = faces === "all" ? DoubleSide : FrontSide;
    this.#front.show(step, supposed?.left);
    this.#frontGeometry.setDrawRange(0, 3 * this.#front.slotCount);
    const written = this.#front.written();
    if (written) this.#upload(...written);
    setRange(this.#frontMaterial, this.#values.rangeAt(step));

    this.#elements.show(step, elements, this.#origin);
    this.#elementGeometry.setDrawRange(0, this.#elements.cornerCount);
    for (const attribute of Object.values(this.#elementGeometry.attributes))
      if (attribute instanceof BufferAttribute) attribute.needsUpdate = true;
    setRange(this.#elementMaterial, this.#elements.range);
  }

  dispose(): void {
    for (const owned of [
      this.#frontGeometry,
      this.#elementGeometry,
      this.#frontMaterial,
      this.#elementMaterial,
    ])
      owned.dispose();
    this.#ramp?.dispose();
  }

  /** Faded faces pale from the nearest to the farthest place of the model. */
  #setDepths({ center, radius }: Sphere, { matrixWorldInverse }: Camera): void {
    const [x, y, z] = this.#origin;
    const distance = -scratch.set(center.x - x, center.y - y, center.z - z).applyMatrix4(matrixWorldInverse)
      .z;
    for (const material of [this.#frontMaterial, this.#elementMaterial]) {
      const depths: unknown = material.uniforms["depths"]?.value;
      if (depths instanceof Vector2) depths.set(distance - radius, distance + radius);
    }
  }

  #setPower(): void {
    const power = this.#frontMaterial.uniforms["power"];
    if (power) power.value = this.#values.power;
  }

  #reset(origin: Position): void {
    this.#origin = origin;
    this.#front.reset(origin, this.#values.valueOf);
  }

  /** Copies slots to the graphics card. */
  #upload(first: number, last: number): void {
    for (const attribute of Object.values(this.#frontGeometry.attributes)) {
      if (!(attribute instanceof BufferAttribute)) continue;
      const perSlot = 3 * attribute.itemSize;
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(perSlot * first, perSlot * (last - first + 1));
      attribute.needsUpdate = true;
    }
  }
}

function setRange(material: ReturnType<typeof createFrontMaterial>, range: readonly [number, number]): void {
  const uniform = material.uniforms["range"];
  if (uniform) uniform.value = range;
}

const scratch = new Vector3();

/** Returns a sphere around positions: about the middle of their box. O(positions). */
function sphereAround(positions: ArrayLike<number>): Sphere {
  const box = new Box3();
  for (let at = 0; at < positions.length; at += 3) box.expandByPoint(scratch.fromArray(positions, at));
  return box.getBoundingSphere(new Sphere());
}
