import { Group, Mesh, type Ray } from "three";
import { setStateColors } from "../draw-state";
import { EntityStates } from "../entity-states";
import { createLineMaterial, fitLines } from "../materials/line-material";
import { nearestSegment, pointOnSegment } from "../nearest";
import type { Position } from "../../document/position";
import type { SampledProject, SceneChanges } from "../scene-state";
import type { Screen } from "../screen";
import { SegmentGeometry, segmentVertices } from "../segment-geometry";
import { addOrigin, type Hit, type HittableLayer } from "./layer";

/** Widths in CSS pixels. */
const normalWidth = 1.6;
const emphasizedWidth = 3.6;
const openWidth = 1.2;
const defectiveWidth = 2.6;
/** Length of a dash and the gap after it, in CSS pixels. */
const dash = 7;

/** The model's lines as sampled by the engine: one buffer of segments, drawn by four passes. */
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
  readonly #meshes = [
    new Mesh(this.#geometry, this.#normal),
    new Mesh(this.#geometry, this.#emphasized),
    new Mesh(this.#geometry, this.#open),
    new Mesh(this.#geometry, this.#defective),
  ] as const;
  /** x y z of both ends per segment, local. */
  #segments = new Float32Array();
  #origin: Position = [0, 0, 0];

  constructor() {
    this.#meshes.forEach((mesh, pass) => {
      mesh.frustumCulled = false;
      mesh.renderOrder = 3 + pass;
      this.root.add(mesh);
    });
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    this.root.visible = state.layers.lines;
    if (changes.has("colors")) {
      const { line: normal, hover, selection: selected, front: defective } = state.colors;
      const colors = { normal, hover, selected, open: normal, defective };
      for (const { material } of this.#meshes) setStateColors(material, colors);
    }
    if (changes.has("viewport")) {
      for (const { material } of this.#meshes) fitLines(material, state.viewport);
    }
    if (changes.has("preview", "origin")) this.#setPositions(state.preview, state.origin);
    this.#states.update(state);
    // Target sizes colour the lines.
    this.#meshes[0].visible = state.shownSizes === null && this.#states.hasAny("normal");
    this.#meshes[1].visible = this.#states.hasAny("hover", "selected");
    this.#meshes[2].visible = this.#states.hasAny("open");
    this.#meshes[3].visible = this.#states.hasAny("defective");
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
    this.#geometry.dispose();
    for (const { material } of this.#meshes) material.dispose();
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
    this.#geometry.dispose();
    this.#segments = new Float32Array(6 * segments);
    this.#geometry = new SegmentGeometry(segments);
    this.#states.attachTo(this.#geometry);
    for (const mesh of this.#meshes) mesh.geometry = this.#geometry;
  }
}
