import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh } from "three";
import type { ViewerColors } from "../colors";
import { createFacetMaterial, setColor } from "../materials";
import type { Position, SceneLayer } from "./layer";

export interface HighlightColors {
  readonly face: string;
  readonly edge: string;
}

/** Triangles pointed out: of one element of the mesh, or of a faulty boundary. Seen through everything. */
export class HighlightLayer implements SceneLayer {
  readonly root = new Group();
  readonly #colorsOf: (colors: ViewerColors) => HighlightColors;
  readonly #plain = createFacetMaterial({ opacity: 0.9, depthWrite: true, polygonOffset: -2 });
  readonly #through = createFacetMaterial({ opacity: 0.3, depthTest: false });
  readonly #edgeMaterial = new LineBasicMaterial({ transparent: true, depthTest: false });
  readonly #faces = [
    new Mesh(new BufferGeometry(), this.#plain),
    new Mesh(new BufferGeometry(), this.#through),
  ] as const;
  readonly #edges = new LineSegments(new BufferGeometry(), this.#edgeMaterial);

  constructor(colorsOf: (colors: ViewerColors) => HighlightColors) {
    this.#colorsOf = colorsOf;
    for (const [order, drawn] of [...this.#faces, this.#edges].entries()) {
      drawn.frustumCulled = false;
      drawn.renderOrder = 2 + 2 * order;
      this.root.add(drawn);
    }
  }

  setColors(colors: ViewerColors): void {
    const { face, edge } = this.#colorsOf(colors);
    setColor(this.#plain, "color", face);
    setColor(this.#through, "color", face);
    this.#edgeMaterial.color.set(edge);
  }

  /** @param corners x y z of three corners per triangle. */
  setTriangles(corners: readonly number[], origin: Position): void {
    const local = Float32Array.from(corners, (x, i) => x - (origin[i % 3] ?? 0));
    const position = new BufferAttribute(local, 3);
    const sides = Uint32Array.from({ length: (2 * local.length) / 3 }, (_, i) => {
      const [triangle, end] = [Math.floor(i / 6), i % 6];
      return 3 * triangle + (((end >> 1) + (end & 1)) % 3);
    });
    for (const { geometry } of [...this.#faces, this.#edges]) geometry.dispose();
    const faces = new BufferGeometry().setAttribute("position", position);
    for (const mesh of this.#faces) mesh.geometry = faces;
    this.#edges.geometry = new BufferGeometry()
      .setAttribute("position", position)
      .setIndex(new BufferAttribute(sides, 1));
    this.root.visible = local.length > 0;
  }

  dispose(): void {
    for (const { geometry } of [...this.#faces, this.#edges]) geometry.dispose();
    for (const material of [this.#plain, this.#through, this.#edgeMaterial]) material.dispose();
  }
}
