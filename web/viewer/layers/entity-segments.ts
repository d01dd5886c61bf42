import { BufferAttribute, BufferGeometry, LineSegments, type Material } from "three";
import type { DrawnKind } from "../../document/entities";
import { EntityStates } from "../entity-states";
import type { SceneState } from "../scene-state";

/** Segments of entities in one buffer, drawn by one pass per material. */
export class EntitySegments {
  readonly passes: readonly LineSegments[];
  readonly states: EntityStates;
  readonly #geometry = new BufferGeometry();
  #ends = new Float32Array();

  constructor(kind: DrawnKind, materials: readonly Material[]) {
    this.states = new EntityStates(kind);
    this.passes = materials.map((material) => new LineSegments(this.#geometry, material));
    for (const pass of this.passes) {
      pass.frustumCulled = false;
      pass.renderOrder = 6;
    }
  }

  /** x y z of both ends per segment, local. */
  get ends(): Float32Array {
    return this.#ends;
  }

  /** Fills the buffer with the segments that `append` writes for each record, as x y z of both ends. */
  lay<Record extends { readonly id: number }>(
    records: readonly Record[],
    append: (record: Record, ends: number[]) => void,
  ): void {
    const ends: number[] = [];
    const offsets = [0];
    for (const record of records) {
      append(record, ends);
      offsets.push(ends.length / 3);
    }
    this.states.assign(records, offsets);
    if (ends.length !== this.#ends.length) this.#allocate(ends.length);
    this.#ends.set(ends);
    const position = this.#geometry.getAttribute("position") as BufferAttribute | undefined;
    if (position) position.needsUpdate = true;
  }

  update(state: SceneState): void {
    this.states.update(state);
    for (const pass of this.passes) pass.visible = this.#ends.length > 0;
  }

  dispose(): void {
    this.#geometry.dispose();
  }

  #allocate(length: number): void {
    this.#geometry.dispose();
    this.#ends = new Float32Array(length);
    this.#geometry.setAttribute("position", new BufferAttribute(this.#ends, 3));
    this.#geometry.setAttribute("state", this.states.attribute);
  }
}
