import { Group, LineSegments, Mesh, type BufferGeometry, type Ray } from "three";
import { drawFirst } from "../draw-first";
import { setStateColors, stateCodes } from "../draw-state";
import { EntityStates } from "../entity-states";
import { createLineMaterial, createThinLineMaterial, fitLines } from "../materials/line-material";
import { nearestSegment, pointOnSegment } from "../nearest";
import type { Position } from "../../document/position";
import type { SampledProject, SceneChanges, SceneState } from "../scene-state";
import type { Screen } from "../screen";
import { segmentCorners, SegmentGeometry, segmentVertices, thinIndex } from "../segment-geometry";
import { addOrigin, type Hit, type HittableLayer } from "./layer";

/** Widths in CSS pixels. */
const normalWidth = 1.6;
const emphasizedWidth = 3.6;
const openWidth = 1.2;
const defectiveWidth = 2.6;
/** Length of a dash and the gap after it, in CSS pixels. */
const dash = 7;

/** Emphasized segments that keep their width while a motion must hurry. More of them are drawn thin. */
const maxHurriedWide = 600;
/** Distance of thin lines from the samples, as a share of the size of the model: half a pixel if this fills the view. */
const thinTolerance = 0.002;
const emphasis = ["hover", "selected"] as const;
const emphasisCodes: ReadonlySet<number> = new Set(emphasis.map((state) => stateCodes[state]));

/**
 * The model's lines as sampled by the engine: one buffer of segments, drawn by four passes. While a motion must hurry, they
 * are one device pixel wide, which in its lower resolution is about their normal width.
 */
export class LinesLayer implements HittableLayer {
  readonly root = new Group();
  readonly #states = new EntityStates("line", { tinted: true });
  #geometry = new SegmentGeometry(0);
  readonly #normal = createLineMaterial({ widths: { normal: normalWidth }, depthTest: true });
  /** Emphasized lines show through everything in front of them. */
  readonly #emphasized = createLineMaterial({
    widths: { hover: emphasizedWidth, selected: emphasizedWidth },
    depthTest: false,
  });
  /** Lines that still lack patches. */
  readonly #open = createLineMaterial({ widths: { open: openWidth }, depthTest: true, dash });
  readonly #defective = createLineMaterial({ widths: { defective: defectiveWidth }, depthTest: true });
  /** The same vertices, with the segments of emphasized lines only. */
  #emphasizedGeometry: BufferGeometry = this.#geometry.sharing(new Uint32Array());
  /** The same vertices, as lines one device pixel wide. */
  #thinGeometry: BufferGeometry = this.#geometry.sharing(new Uint32Array());
  #isThinMade = false;
  readonly #thin = new LineSegments(
    this.#thinGeometry,
    createThinLineMaterial(["normal", "open", "defective"], true),
  );
  readonly #thinEmphasized = new LineSegments(this.#thinGeometry, createThinLineMaterial(emphasis, false));
  readonly #meshes = [
    new Mesh(this.#geometry, this.#normal),
    new Mesh(this.#emphasizedGeometry, this.#emphasized),
    new Mesh(this.#geometry, this.#open),
    new Mesh(this.#geometry, this.#defective),
  ] as const;
  /** x y z of both ends per segment, local. */
  #segments = new Float32Array();
  #origin: Position = [0, 0, 0];

  constructor() {
    const [normal, emphasized, ...others] = this.#meshes;
    [[normal, this.#thin], [emphasized, this.#thinEmphasized], ...others.map((mesh) => [mesh])].forEach(
      (drawn, pass) => {
        for (const object of drawn) {
          object.frustumCulled = false;
          object.renderOrder = 3 + pass;
          this.root.add(object);
        }
      },
    );
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    this.root.visible = state.layers.lines;
    if (changes.has("colors")) {
      const { line: normal, hover, selection: selected, front: defective } = state.colors;
      const colors = { normal, hover, selected, open: normal, defective };
      for (const { material } of [...this.#meshes, this.#thin, this.#thinEmphasized])
        setStateColors(material, colors);
    }
    if (changes.has("viewport")) {
      for (const { material } of this.#meshes) fitLines(material, state.viewport);
    }
    if (changes.has("preview", "origin")) {
      this.#setPositions(state.preview, state.origin);
      // A line that is dragged may bend.
      this.#isThinMade = false;
    }
    this.#states.update(state);
    if (changes.has("preview", "origin", "hover", "selection", "hidden")) this.#setEmphasized();
    this.#choosePasses(state);
  }

  #choosePasses({ viewport: { isHurried }, shownSizes }: SceneState): void {
    const [normal, emphasized, open, defective] = this.#meshes;
    const isThin = isHurried && shownSizes === null;
    if (isThin) this.#makeThin();
    this.#thin.visible = isThin;
    // Target sizes colour the lines.
    normal.visible = !isThin && shownSizes === null && this.#states.hasAny("normal");
    open.visible = !isThin && this.#states.hasAny("open");
    defective.visible = !isThin && this.#states.hasAny("defective");
    const isAny = this.#states.hasAny(...emphasis);
    const { count } = this.#emphasizedGeometry.drawRange;
    this.#thinEmphasized.visible = isAny && isThin && count > segmentCorners * maxHurriedWide;
    emphasized.visible = isAny && !this.#thinEmphasized.visible;
  }

  /** Chooses the thin lines, unless they are known. */
  #makeThin(): void {
    if (this.#isThinMade) return;
    this.#isThinMade = true;
    const offsets = Array.from(
      { length: this.#states.length + 1 },
      (_, line) => this.#states.firstVertexOf(line) / segmentVertices,
    );
    let size = 0;
    for (const x of this.#segments) size = Math.max(size, Math.abs(x));
    const index = thinIndex(this.#segments, offsets, thinTolerance * size);
    this.#thinGeometry.getIndex()?.array.set(index);
    drawFirst(this.#thinGeometry, index.length);
  }

  /** Writes the index of the emphasized segments. */
  #setEmphasized(): void {
    const all = this.#geometry.getIndex();
    const drawn = this.#emphasizedGeometry.getIndex();
    if (!all || !drawn) return;
    let count = 0;
    for (let line = 0; line < this.#states.length; ++line) {
      if (!emphasisCodes.has(this.#states.codeAt(line))) continue;
      const [first, end] = [line, line + 1].map(
        (index) => (segmentCorners * this.#states.firstVertexOf(index)) / segmentVertices,
      );
      drawn.array.set(all.array.subarray(first, end), count);
      count += (end ?? 0) - (first ?? 0);
    }
    drawFirst(this.#emphasizedGeometry, count);
  }

  hit(_ray: Ray, screen: Screen): Hit | null {
    if (!this.root.visible) return null;
    const nearest = nearestSegment(this.#segments, screen, (segment) =>
      this.#states.canHit(segmentVertices * segment, screen),
    );
    const target = nearest && this.#states.entityAt(this.#states.recordOf(segmentVertices * nearest.index));
    if (!target) return null;
    const position = addOrigin(pointOnSegment(this.#segments, nearest), this.#origin);
    return { target, position, depth: nearest.depth };
  }

  dispose(): void {
    for (const geometry of [this.#geometry, this.#emphasizedGeometry, this.#thinGeometry]) geometry.dispose();
    for (const { material } of [...this.#meshes, this.#thin, this.#thinEmphasized]) material.dispose();
  }

  #setPositions(preview: SampledProject | null, origin: Position): void {
    const { lineOffsets, linePoints } = preview?.samples ?? { lineOffsets: [0], linePoints: [] };
    this.#origin = origin;
    // A line of n samples has n - 1 segments. One that cannot be sampled, for want of length, has neither.
    const offsets = new Uint32Array(lineOffsets.length);
    for (let line = 0; line + 1 < lineOffsets.length; ++line) {
      const segments = Math.max(0, (lineOffsets[line + 1] ?? 0) - (lineOffsets[line] ?? 0) - 1);
      offsets[line + 1] = (offsets[line] ?? 0) + segmentVertices * segments;
    }
    const count = (offsets.at(-1) ?? 0) / segmentVertices;
    this.#states.assign(preview?.project.lines ?? [], offsets);
    if (6 * count !== this.#segments.length) this.#allocate(count);
    let at = 0;
    for (let line = 0; line + 1 < lineOffsets.length; ++line) {
      const last = (lineOffsets[line + 1] ?? 0) - 1;
      for (let sample = lineOffsets[line] ?? 0; sample < last; ++sample) {
        for (let k = 3 * sample; k < 3 * sample + 6; ++k) {
          this.#segments[at++] = (linePoints[k] ?? 0) - (origin[k % 3] ?? 0);
        }
      }
    }
    this.#geometry.setEnds(this.#segments);
  }

  #allocate(segments: number): void {
    for (const geometry of [this.#geometry, this.#emphasizedGeometry, this.#thinGeometry]) geometry.dispose();
    this.#segments = new Float32Array(6 * segments);
    this.#geometry = new SegmentGeometry(segments);
    this.#states.attachTo(this.#geometry);
    for (const mesh of this.#meshes) mesh.geometry = this.#geometry;
    this.#emphasizedGeometry = this.#geometry.sharing(new Uint32Array(segmentCorners * segments));
    this.#meshes[1].geometry = this.#emphasizedGeometry;
    this.#thinGeometry = this.#geometry.sharing(new Uint32Array(2 * segments));
    for (const drawn of [this.#thin, this.#thinEmphasized]) drawn.geometry = this.#thinGeometry;
  }
}
