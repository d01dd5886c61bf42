import {
  BufferAttribute,
  BufferGeometry,
  Group,
  InstancedBufferAttribute,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
  Points,
} from "three";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { Position } from "../../document/position";
import { setStateColors, stateCodes } from "../draw-state";
import { createDotMaterial } from "../materials/dot-material";
import { createLineMaterial } from "../materials/line-material";
import { createPatchMaterial } from "../materials/patch-material";
import { setColor, setNumber } from "../materials/uniforms";
import type { SceneChanges } from "../scene-state";
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
  readonly #lines = new Mesh(new LineSegmentsGeometry(), this.#lineMaterial);
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
      this.#lineMaterial.uniforms.resolution.value.set(viewport.width, viewport.height);
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
    this.#lines.geometry = this.#segments(this.#local(ends));
    this.#lines.visible = ends.length > 0;
    this.#setPoints(this.#dots, dots);
    this.#setPoints(this.#faces, triangles);
  }

  #segments(ends: Float32Array): LineSegmentsGeometry {
    const buffer = new InstancedInterleavedBuffer(ends, 6, 1);
    const geometry = new LineSegmentsGeometry();
    geometry.setAttribute("instanceStart", new InterleavedBufferAttribute(buffer, 3, 0));
    geometry.setAttribute("instanceEnd", new InterleavedBufferAttribute(buffer, 3, 3));
    const states = new Uint8Array(ends.length / 6).fill(stateCodes.selected);
    geometry.setAttribute("state", new InstancedBufferAttribute(states, 1));
    geometry.instanceCount = states.length;
    return geometry;
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
