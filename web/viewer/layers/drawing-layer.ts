import { BufferAttribute, BufferGeometry, Group, Mesh, Points } from "three";
import type { Position } from "../../document/position";
import { setStateColors, stateCodes } from "../draw-state";
import { createDotMaterial } from "../materials/dot-material";
import { createLineMaterial, fitLines } from "../materials/line-material";
import { createPatchMaterial } from "../materials/patch-material";
import { setColor, setNumber } from "../materials/uniforms";
import type { SceneChanges } from "../scene-state";
import { SegmentGeometry, segmentsInState } from "../segment-geometry";
import type { Layer } from "./layer";

/** What a tool is about to create, in model coordinates. */
export interface Sketch {
  readonly paths: readonly (readonly Position[])[];
  readonly dots: readonly Position[];
  /** Three corners per triangle. */
  readonly triangles: readonly Position[];
}

export const emptySketch: Sketch = { paths: [], dots: [], triangles: [] };

const width = 2.2;

/** What a tool is about to create: paths, dots and a surface, in front of everything. */
export class DrawingLayer implements Layer {
  readonly root = new Group();
  readonly #lineMaterial = createLineMaterial({ widths: { selected: width }, depthTest: false });
  readonly #dotMaterial = createDotMaterial("round");
  readonly #faceMaterial = createPatchMaterial({ opacities: { selected: 0.45 }, depthTest: false });
  readonly #lines = new Mesh(new SegmentGeometry(0), this.#lineMaterial);
  readonly #dots = new Points(new BufferGeometry(), this.#dotMaterial);
  readonly #faces = new Mesh(new BufferGeometry(), this.#faceMaterial);
  #sketch: Sketch = emptySketch;
  #origin: Position = [0, 0, 0];

  constructor() {
    for (const [order, drawn] of [this.#faces, this.#lines, this.#dots].entries()) {
      drawn.frustumCulled = false;
      drawn.renderOrder = 8 + order;
      this.root.add(drawn);
    }
  }

  show(sketch: Sketch): void {
    this.#sketch = sketch;
    this.#write();
  }

  update(changes: SceneChanges): void {
    const { colors, viewport, origin } = changes.state;
    if (changes.has("colors")) {
      for (const material of [this.#lineMaterial, this.#dotMaterial, this.#faceMaterial]) {
        setStateColors(material, { selected: colors.selection });
      }
      setColor(this.#dotMaterial, "rim", colors.faded);
    }
    if (changes.has("viewport")) {
      fitLines(this.#lineMaterial, viewport);
      setNumber(this.#dotMaterial, "pixelRatio", viewport.pixelRatio);
    }
    if (!changes.has("origin")) return;
    this.#origin = origin;
    this.#write();
  }

  dispose(): void {
    for (const { geometry } of [this.#lines, this.#dots, this.#faces]) geometry.dispose();
    for (const material of [this.#lineMaterial, this.#dotMaterial, this.#faceMaterial]) material.dispose();
  }

  #write(): void {
    const { paths, dots, triangles } = this.#sketch;
    const ends = paths.flatMap((path) => path.slice(1).flatMap((to, i) => [path[i] ?? to, to]));
    this.#lines.geometry.dispose();
    this.#lines.geometry = segmentsInState(this.#local(ends), stateCodes.selected);
    this.#lines.visible = ends.length > 0;
    this.#setPoints(this.#dots, dots);
    this.#setPoints(this.#faces, triangles);
  }

  #setPoints(drawn: Points | Mesh, positions: readonly Position[]): void {
    const states = new Uint8Array(positions.length).fill(stateCodes.selected);
    drawn.geometry.dispose();
    drawn.geometry = new BufferGeometry()
      .setAttribute("position", new BufferAttribute(this.#local(positions), 3))
      .setAttribute("state", new BufferAttribute(states, 1));
    drawn.visible = positions.length > 0;
  }

  #local(positions: readonly Position[]): Float32Array<ArrayBuffer> {
    const [x, y, z] = this.#origin;
    return Float32Array.from(positions.flatMap((p) => [p[0] - x, p[1] - y, p[2] - z]));
  }
}
