import type { Trace } from "tetrafront/trace";
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
import type { Position } from "../../document/position";
import type { Layer } from "../../viewer/layers/layer";
import { rampTexture } from "../../viewer/materials/textures";
import { setColor, setNumber, setTexture } from "../../viewer/materials/uniforms";
import type { SceneChanges } from "../../viewer/scene-state";
import { ElementBuffers } from "./element-buffers";
import { FrontBuffers } from "./front-buffers";
import { wholeMesh, type WholeChoice } from "./whole-mesh";
import { createFrontMaterial } from "./front-material";
import { type FrontColoring, frontValues, type FrontValues } from "./front-values";
import { elementsShown, isUnfinished, showsWhole } from "./film-state";
import type { FrontChange } from "./judge";
import type { PlayerState } from "./player";

/** In a film, as many of the elements made last have the colours of the newest. */
const freshCount = 150;

interface ShownWhole extends WholeChoice {
  readonly step: number;
}

/** How a state is drawn. */
export interface Drawn {
  /** Whether the front stays behind what the lens shows. */
  readonly isFaded: boolean;
  /** Whether the front near the step is shown instead. */
  readonly isNear: boolean;
  /** Instead of what the step has made, the state before it is shown, without the faces that would leave the front. */
  readonly supposed: FrontChange | null;
}

/** The front of a trace after a step, and the elements made last. */
export class ReplayLayer implements Layer {
  readonly root = new Group();
  readonly #trace: Trace;
  readonly #front: FrontBuffers;
  readonly #elements: ElementBuffers;
  readonly #frontMaterial = createFrontMaterial({ opacity: 1 });
  readonly #elementMaterial = createFrontMaterial({ opacity: 0.85 });
  readonly #wholeMaterial = createFrontMaterial({ opacity: 1 });
  readonly #whole = new Mesh(new BufferGeometry(), this.#wholeMaterial);
  readonly #materials = [this.#frontMaterial, this.#elementMaterial, this.#wholeMaterial];
  readonly #frontMesh: Mesh;
  readonly #bounds: Sphere;
  #shownWhole: ShownWhole | null = null;
  readonly #frontGeometry = new BufferGeometry();
  readonly #elementGeometry = new BufferGeometry();
  #ramp: DataTexture | null = null;
  /** Colours of elements in a film. */
  #warmRamp: DataTexture | null = null;
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
    const front = (this.#frontMesh = new Mesh(this.#frontGeometry, this.#frontMaterial));
    const elements = new Mesh(this.#elementGeometry, this.#elementMaterial);
    const bounds = (this.#bounds = sphereAround(trace.nodes.positions));
    for (const mesh of [front, elements, this.#whole]) {
      mesh.onBeforeRender = (_renderer, _scene, camera) => this.#setDepths(bounds, camera);
      mesh.frustumCulled = false;
      // For the order of drawing; three.js would look at all corners.
      mesh.geometry.boundingSphere = new Sphere();
    }
    this.#whole.visible = false;
    this.root.add(front, elements, this.#whole);
  }

  update(changes: SceneChanges): void {
    const { colors, origin } = changes.state;
    if (changes.has("colors")) {
      this.#ramp?.dispose();
      this.#warmRamp?.dispose();
      this.#ramp = rampTexture(colors.ramp);
      this.#warmRamp = rampTexture([colors.filled, colors.filled, colors.fresh]);
      for (const material of this.#materials) {
        setTexture(material, "ramp", this.#ramp);
        setColor(material, "edgeColor", colors.meshEdge);
        setColor(material, "plain", colors.meshPlain);
        setColor(material, "background", colors.faded);
      }
    }
    if (changes.has("origin")) this.#reset(origin);
  }

  /** Shows a state of the player; nothing before the volume. The cost of a few steps is that of their faces. */
  show(state: PlayerState, { isFaded, isNear, supposed }: Drawn): void {
    const { step: after, sweep, coloring, faces } = state;
    this.root.visible = after >= 0 && sweep === null;
    if (after < 0) return;
    const step = supposed || isUnfinished(state) ? after - 1 : after;
    if (coloring !== this.#coloring) {
      this.#coloring = coloring;
      this.#values = frontValues(this.#trace, coloring);
      this.#setPower();
      this.#reset(this.#origin);
    }
    for (const material of this.#materials) setNumber(material, "fading", isFaded ? 1 : 0);
    this.#frontMaterial.side = faces === "all" ? DoubleSide : FrontSide;
    this.#frontMesh.visible = !isNear;
    if (!isNear) {
      this.#front.show(step, supposed?.left);
      this.#frontGeometry.setDrawRange(0, 3 * this.#front.slotCount);
      const written = this.#front.written();
      if (written) this.#upload(...written);
      setRange(this.#frontMaterial, this.#values.rangeAt(step));
    }
    this.#showElements(state, step, isNear);
  }

  #showElements(state: PlayerState, step: number, isNear: boolean): void {
    const { film, cutAt, apart } = state;
    const elements = elementsShown(state);
    for (const material of [this.#elementMaterial, this.#wholeMaterial])
      setTexture(material, "ramp", film ? this.#warmRamp : this.#ramp);
    const isWhole = showsWhole(state);
    const choice = { cutAt: elements === "cut" ? cutAt : null, isApart: apart > 0 };
    this.#showWhole(isWhole ? { step, ...choice } : null);
    setNumber(this.#wholeMaterial, "apart", apart);
    const made = this.#trace.steps.elementsMade[step] ?? 1;
    setRange(this.#wholeMaterial, [film ? made - freshCount : 0, made]);
    // What the step makes is part of its marks; other elements could hide it.
    this.#elements.show(step, isWhole || isNear ? "none" : elements, this.#origin);
    this.#elementGeometry.setDrawRange(0, this.#elements.cornerCount);
    for (const attribute of Object.values(this.#elementGeometry.attributes))
      if (attribute instanceof BufferAttribute) attribute.needsUpdate = true;
    setRange(this.#elementMaterial, this.#elements.range);
  }

  /** Shows all elements of a state; none for null. */
  #showWhole(shown: ShownWhole | null): void {
    const before = this.#shownWhole;
    const isSame =
      shown?.step === before?.step && shown?.cutAt === before?.cutAt && shown?.isApart === before?.isApart;
    if (isSame) return;
    this.#shownWhole = shown;
    this.#whole.visible = shown !== null;
    this.#whole.geometry.dispose();
    this.#whole.geometry = new BufferGeometry();
    this.#whole.geometry.boundingSphere = new Sphere();
    if (!shown) return;
    const { positions, values, centroids } = wholeMesh(this.#trace, shown.step, shown, this.#origin);
    this.#whole.geometry
      .setAttribute("position", new BufferAttribute(positions, 3))
      .setAttribute("value", new BufferAttribute(values, 1));
    if (shown.isApart) this.#whole.geometry.setAttribute("ownCentre", new BufferAttribute(centroids, 3));
    const middle: unknown = this.#wholeMaterial.uniforms["middle"]?.value;
    if (middle instanceof Vector3) middle.copy(this.#bounds.center).sub(scratch.fromArray([...this.#origin]));
  }

  dispose(): void {
    for (const owned of [
      this.#frontGeometry,
      this.#elementGeometry,
      this.#whole.geometry,
      this.#frontMaterial,
      this.#elementMaterial,
      this.#wholeMaterial,
    ])
      owned.dispose();
    this.#ramp?.dispose();
    this.#warmRamp?.dispose();
  }

  /** Faded faces pale from the nearest to the farthest place of the model. */
  #setDepths({ center, radius }: Sphere, { matrixWorldInverse }: Camera): void {
    const [x, y, z] = this.#origin;
    const distance = -scratch.set(center.x - x, center.y - y, center.z - z).applyMatrix4(matrixWorldInverse)
      .z;
    for (const material of this.#materials) {
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
    this.#showWhole(null);
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
