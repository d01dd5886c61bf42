import { BufferAttribute, type BufferGeometry } from "three";
import { entityKey, sameEntity, type DrawnKind, type Entity } from "../document/entities";
import { stateCodes, type DrawState } from "./draw-state";
import type { SceneState } from "./scene-state";
import type { Screen } from "./screen";

interface Identified {
  readonly id: number;
}

type Emphasis = Pick<SceneState, "selection" | "hover" | "hidden" | "defects" | "tints">;

/**
 * The draw states of the entities of one kind, as a vertex attribute with one byte per vertex. A change of hover,
 * selection or visibility writes the bytes of the entities that it concerns, and leaves all others.
 */
export class EntityStates {
  readonly #kind: DrawnKind;
  readonly #tinted: boolean;
  #records: readonly Identified[] = [];
  /** Record i owns the vertices from offsets[i] to before offsets[i + 1]. */
  #offsets: ArrayLike<number> = [0];
  #attribute: BufferAttribute;
  #tint: BufferAttribute;
  #codes = new Uint8Array();
  readonly #counts = new Map<number, number>();
  #indexById: ReadonlyMap<number, number> | null = null;
  /** The emphasis that the attribute shows; null if states are still to be written. */
  #shown: Emphasis | null = null;
  #selectedIds: ReadonlySet<number> = new Set();

  /** If `tinted`, there are colours of groups. */
  constructor(kind: DrawnKind, { tinted = false } = {}) {
    this.#kind = kind;
    this.#tinted = tinted;
    this.#attribute = this.#createAttribute(0);
    this.#tint = this.#createTint(0);
  }

  /** One state code per vertex. */
  get attribute(): BufferAttribute {
    return this.#attribute;
  }

  /** Gives a geometry the states, and the tints if there are any. */
  attachTo(geometry: BufferGeometry): void {
    geometry.setAttribute("state", this.#attribute);
    if (this.#tinted) geometry.setAttribute("tint", this.#tint);
  }

  /**
   * Assigns vertices to records. The attribute is replaced only if the number of vertices changes. Returns whether the
   * record at each index still owns the same vertices.
   */
  assign(records: readonly Identified[], offsets: ArrayLike<number>): boolean {
    const vertices = offsets[records.length] ?? 0;
    const sameVertices = sameNumbers(this.#offsets, offsets);
    const isSame = sameVertices && sameIds(this.#records, records);
    this.#records = records;
    if (isSame) return true;
    this.#offsets = offsets;
    this.#indexById = null;
    this.#shown = null;
    if (this.#attribute.count !== vertices) {
      this.#attribute = this.#createAttribute(vertices);
      this.#tint = this.#createTint(vertices);
    }
    return sameVertices;
  }

  /** Writes the states that differ from those shown. */
  update(state: Emphasis): void {
    const before = this.#shown;
    this.#shown = state;
    if (!before || before.selection !== state.selection) {
      this.#selectedIds = new Set(state.selection.filter(this.#isOfKind).map(({ id }) => id));
    }
    if (this.#tinted && before?.tints !== state.tints) this.#writeTints(state);
    if (!before) return this.#writeAll(state);
    for (const id of this.#affectedIds(before, state)) {
      const index = this.#indexOf(id);
      if (index !== undefined) this.#write(index, this.#codeOf(id, state));
    }
  }

  /** Number of records. */
  get length(): number {
    return this.#records.length;
  }

  /** State code of the record at an index. */
  codeAt(index: number): number {
    return this.#codes[index] ?? stateCodes.hidden;
  }

  /** First of the vertices that a record owns. */
  firstVertexOf(index: number): number {
    return this.#offsets[index] ?? 0;
  }

  /** Index of the record that owns a vertex. */
  recordOf(vertex: number): number {
    let [low, high] = [0, this.#records.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.#offsets[middle + 1] ?? 0) > vertex) high = middle;
      else low = middle + 1;
    }
    return low;
  }

  /** Returns whether a vertex is drawn. */
  isDrawn(vertex: number): boolean {
    return this.#attribute.getX(vertex) !== stateCodes.hidden;
  }

  /** Returns whether a vertex is drawn and belongs to an entity that a hit test does not pass through. */
  canHit(vertex: number, { isSkipped }: Pick<Screen, "isSkipped">): boolean {
    if (!this.isDrawn(vertex)) return false;
    const entity = this.entityAt(this.recordOf(vertex));
    return entity !== null && !isSkipped(entity);
  }

  /** Returns whether any entity has one of these states. */
  hasAny(...states: readonly DrawState[]): boolean {
    return states.some((state) => (this.#counts.get(stateCodes[state]) ?? 0) > 0);
  }

  /** The entity of a record. */
  entityAt(index: number): Entity | null {
    const record = this.#records[index];
    return record ? { kind: this.#kind, id: record.id } : null;
  }

  /** Drawn patches and those of bodies have ids of their own. */
  get #isPatch(): boolean {
    return this.#kind === "patch" || this.#kind === "body-patch";
  }

  readonly #isOfKind = ({ kind }: Entity): boolean => kind === this.#kind;

  #createAttribute(vertices: number): BufferAttribute {
    return new BufferAttribute(new Uint8Array(vertices), 1);
  }

  /** Red, green, blue and whether there is no tint, per vertex. */
  #createTint(vertices: number): BufferAttribute {
    const tints = new Uint8Array(this.#tinted ? 4 * vertices : 0).fill(255);
    return new BufferAttribute(tints, 4, true);
  }

  #writeTints({ tints }: Emphasis): void {
    this.#records.forEach(({ id }, index) => {
      const tint = tints.get(entityKey({ kind: this.#kind, id }));
      const bytes = tint ? [...tint.map((part) => Math.round(255 * part)), 0] : [255, 255, 255, 255];
      for (let vertex = this.#offsets[index] ?? 0; vertex < (this.#offsets[index + 1] ?? 0); ++vertex) {
        this.#tint.array.set(bytes, 4 * vertex);
      }
    });
    this.#tint.needsUpdate = true;
  }

  #indexOf(id: number): number | undefined {
    this.#indexById ??= new Map(this.#records.map((record, index) => [record.id, index]));
    return this.#indexById.get(id);
  }

  #codeOf(id: number, { hover, hidden, defects }: Emphasis): number {
    const entity = { kind: this.#kind, id };
    if (hidden.size > 0 && hidden.has(entityKey(entity))) return stateCodes.hidden;
    if (this.#selectedIds.has(id)) return stateCodes.selected;
    if (sameEntity(hover, entity)) return stateCodes.hover;
    if (this.#isPatch && defects.patches.has(id)) return stateCodes.defective;
    if (this.#kind !== "line" || !defects.openLines.has(id)) return stateCodes.normal;
    return defects.areOpenLinesExpected ? stateCodes.open : stateCodes.defective;
  }

  #writeAll(state: Emphasis): void {
    this.#codes = Uint8Array.from(this.#records, ({ id }) => this.#codeOf(id, state));
    this.#counts.clear();
    this.#codes.forEach((code, index) => {
      this.#count(code, 1);
      this.#attribute.array.fill(code, this.#offsets[index], this.#offsets[index + 1]);
    });
    this.#attribute.clearUpdateRanges();
    this.#attribute.addUpdateRange(0, this.#attribute.count);
    this.#attribute.needsUpdate = true;
  }

  #write(index: number, code: number): void {
    const before = this.codeAt(index);
    if (before === code) return;
    this.#codes[index] = code;
    this.#count(before, -1);
    this.#count(code, 1);
    const first = this.#offsets[index] ?? 0;
    const end = this.#offsets[index + 1] ?? first;
    this.#attribute.array.fill(code, first, end);
    this.#attribute.addUpdateRange(first, end - first);
    this.#attribute.needsUpdate = true;
  }

  #count(code: number, change: number): void {
    this.#counts.set(code, (this.#counts.get(code) ?? 0) + change);
  }

  #affectedIds(before: Emphasis, now: Emphasis): Set<number> {
    const ids = new Set<number>();
    const add = (entity: Entity | null): void => {
      if (entity && this.#isOfKind(entity)) ids.add(entity.id);
    };
    if (before.hover !== now.hover) [before.hover, now.hover].forEach(add);
    if (before.selection !== now.selection) [...before.selection, ...now.selection].forEach(add);
    if (before.hidden !== now.hidden) {
      const prefix = `${this.#kind}-`;
      for (const key of [...before.hidden, ...now.hidden]) {
        if (key.startsWith(prefix)) ids.add(Number(key.slice(prefix.length)));
      }
    }
    if (this.#isPatch && before.defects !== now.defects) {
      for (const { patches } of [before.defects, now.defects]) patches.forEach((id) => ids.add(id));
    }
    if (this.#kind === "line" && before.defects !== now.defects) {
      for (const { openLines } of [before.defects, now.defects]) openLines.forEach((id) => ids.add(id));
    }
    return ids;
  }
}

/** Returns where the vertices of each record begin, and where those of the last one end. */
export function offsetsOf<Record>(
  records: readonly Record[],
  verticesOf: (record: Record) => number,
): Uint32Array {
  const offsets = new Uint32Array(records.length + 1);
  records.forEach((record, i) => (offsets[i + 1] = (offsets[i] ?? 0) + verticesOf(record)));
  return offsets;
}

function sameNumbers(a: ArrayLike<number>, b: ArrayLike<number>): boolean {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; ++i) if (a[i] !== b[i]) return false;
  return true;
}

function sameIds(a: readonly Identified[], b: readonly Identified[]): boolean {
  return a === b || (a.length === b.length && a.every(({ id }, i) => id === b[i]?.id));
}
