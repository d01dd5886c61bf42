import type { ProjectPreview } from "tetrafront";
import { Group } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { ViewerColors } from "../colors";
import type { Position, SceneLayer } from "./layer";

/** Widths on the screen in pixels. */
const normalWidth = 1.6;
const markedWidth = 3.6;

type Marking = "normal" | "hover" | "selected";

/** The model's lines as sampled by the engine, one bundle per way of drawing them. */
export class LinesLayer implements SceneLayer {
  readonly root = new Group();
  readonly #bundles: { readonly [M in Marking]: LineSegments2 };
  #preview: ProjectPreview | null = null;
  #origin: Position = [0, 0, 0];

  constructor() {
    this.#bundles = {
      normal: createBundle(normalWidth, 3, true),
      hover: createBundle(markedWidth, 4, false),
      selected: createBundle(markedWidth, 4, false),
    };
    this.root.add(...Object.values(this.#bundles));
  }

  setColors(colors: ViewerColors): void {
    this.#bundles.normal.material.color.set(colors.line);
    this.#bundles.hover.material.color.set(colors.hover);
    this.#bundles.selected.material.color.set(colors.selection);
  }

  setResolution(width: number, height: number): void {
    for (const bundle of Object.values(this.#bundles)) bundle.material.resolution.set(width, height);
  }

  setPreview(preview: ProjectPreview | null, origin: Position): void {
    this.#preview = preview;
    this.#origin = origin;
  }

  /** Rebuilds the bundles. `markingOf` tells how to draw the line at a position; null hides it. */
  update(markingOf: (position: number) => Marking | null): void {
    const segments: Record<Marking, number[]> = { normal: [], hover: [], selected: [] };
    const lineCount = (this.#preview?.lineOffsets.length ?? 1) - 1;
    for (let position = 0; position < lineCount; ++position) {
      const marking = markingOf(position);
      if (marking) this.#append(position, segments[marking]);
    }
    for (const marking of ["normal", "hover", "selected"] as const) {
      const bundle = this.#bundles[marking];
      bundle.visible = segments[marking].length > 0;
      if (!bundle.visible) continue;
      bundle.geometry.dispose();
      bundle.geometry = new LineSegmentsGeometry().setPositions(segments[marking]);
    }
  }

  dispose(): void {
    for (const bundle of Object.values(this.#bundles)) {
      bundle.geometry.dispose();
      bundle.material.dispose();
    }
  }

  #append(position: number, segments: number[]): void {
    if (!this.#preview) return;
    const { linePoints, lineOffsets } = this.#preview;
    const last = (lineOffsets[position + 1] ?? 0) - 1;
    for (let i = lineOffsets[position] ?? 0; i < last; ++i) {
      for (let k = 3 * i; k < 3 * i + 6; ++k)
        segments.push((linePoints[k] ?? 0) - (this.#origin[k % 3] ?? 0));
    }
  }
}

/** Marked lines show through what lies before them. */
function createBundle(linewidth: number, renderOrder: number, depthTest: boolean): LineSegments2 {
  const material = new LineMaterial({
    linewidth,
    depthTest,
    toneMapped: false,
    polygonOffset: true,
    polygonOffsetFactor: -2,
    polygonOffsetUnits: -2,
  });
  const bundle = new LineSegments2(new LineSegmentsGeometry(), material);
  bundle.frustumCulled = false;
  bundle.visible = false;
  bundle.renderOrder = renderOrder;
  return bundle;
}
