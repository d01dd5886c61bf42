import { BufferAttribute, BufferGeometry, Points, type Ray } from "three";
import type { DrawnKind } from "../../document/entities";
import type { Layer as LayerName } from "../../document/selection";
import type { ViewerColors } from "../colors";
import { setStateColors } from "../draw-state";
import { EntityStates, offsetsOf } from "../entity-states";
import { createDotMaterial } from "../materials/dot-material";
import { setColor, setNumber } from "../materials/uniforms";
import { nearestDot } from "../nearest";
import type { Position } from "../../document/position";
import type { SceneChanges, SceneState } from "../scene-state";
import type { Screen } from "../screen";
import type { Hit, HittableLayer } from "./layer";

interface Dotted {
  readonly id: number;
}

export interface DotsOptions<Record extends Dotted> {
  readonly kind: DrawnKind;
  /** The switch that shows the layer. */
  readonly name: LayerName;
  readonly shape: "round" | "square";
  readonly color: (colors: ViewerColors) => string;
  readonly records: (state: SceneState) => readonly Record[];
  /** Returns the positions of a record's dots. */
  readonly positions: (record: Record) => readonly Position[];
}

/** Entities drawn as dots: the model's points, nodes of the background grid, ends of sources. */
export class DotsLayer<Record extends Dotted> implements HittableLayer {
  readonly root: Points;
  readonly #options: DotsOptions<Record>;
  readonly #material;
  readonly #geometry = new BufferGeometry();
  readonly #states: EntityStates;
  #records: readonly Record[] = [];
  #origin: Position | null = null;
  #position = new BufferAttribute(new Float32Array(), 3);

  constructor(options: DotsOptions<Record>) {
    this.#options = options;
    this.#states = new EntityStates(options.kind, { tinted: options.kind === "point" });
    this.#material = createDotMaterial(options.shape);
    this.root = new Points(this.#geometry, this.#material);
    this.root.frustumCulled = false;
    this.root.renderOrder = 5;
  }

  /** Local x y z per dot. */
  get positions(): BufferAttribute {
    return this.#position;
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    this.root.visible = state.layers[this.#options.name];
    if (changes.has("colors")) this.#setColors(state.colors);
    if (changes.has("viewport")) setNumber(this.#material, "pixelRatio", state.viewport.pixelRatio);
    // A background grid may be large, so nothing is written while it is not shown.
    if (!this.root.visible) return;
    this.#setPositions(this.#options.records(state), state.origin);
    this.#states.update(state);
  }

  hit(_ray: Ray, screen: Screen): Hit | null {
    if (!this.root.visible) return null;
    const nearest = nearestDot(this.#position.array, screen, (dot) => this.#states.canHit(dot, screen));
    const target = nearest && this.#states.entityAt(this.#states.recordOf(nearest.index));
    const position = nearest && this.#positionOf(nearest.index);
    return target && position ? { target, position, depth: nearest.depth } : null;
  }

  dispose(): void {
    this.#geometry.dispose();
    this.#material.dispose();
  }

  #setColors(colors: ViewerColors): void {
    const { hover, selection: selected, faded } = colors;
    setColor(this.#material, "rim", faded);
    setStateColors(this.#material, { normal: this.#options.color(colors), hover, selected });
  }

  /** Writes the positions of records that are new; those of all others stay in the buffer. */
  #setPositions(records: readonly Record[], origin: Position): void {
    if (records === this.#records && origin === this.#origin) return;
    const before = origin === this.#origin ? this.#records : [];
    const offsets = offsetsOf(records, (record) => this.#options.positions(record).length);
    const isSameSize = this.#states.assign(records, offsets) && before.length === records.length;
    if (!isSameSize) this.#allocate(offsets[records.length] ?? 0);
    const array = this.#position.array;
    records.forEach((record, i) => {
      if (isSameSize && record === before[i]) return;
      const first = 3 * (offsets[i] ?? 0);
      let at = first;
      for (const position of this.#options.positions(record)) {
        for (let k = 0; k < 3; ++k) array[at++] = (position[k] ?? 0) - (origin[k] ?? 0);
      }
      if (isSameSize) this.#position.addUpdateRange(first, at - first);
    });
    this.#position.needsUpdate = true;
    this.#records = records;
    this.#origin = origin;
  }

  #allocate(dots: number): void {
    this.#geometry.dispose();
    this.#position = new BufferAttribute(new Float32Array(3 * dots), 3);
    this.#geometry.setAttribute("position", this.#position);
    this.#states.attachTo(this.#geometry);
  }

  #positionOf(dot: number): Position | null {
    const index = this.#states.recordOf(dot);
    const record = this.#records[index];
    return record ? (this.#options.positions(record)[dot - this.#states.firstVertexOf(index)] ?? null) : null;
  }
}
