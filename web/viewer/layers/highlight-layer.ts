import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh } from "three";
import type { ViewerColors } from "../colors";
import { createFacetMaterial } from "../materials/facet-material";
import { setColor } from "../materials/uniforms";
import type { Position } from "../../document/position";
import type { SceneChanges, SceneState } from "../scene-state";
import type { Layer } from "./layer";

export interface HighlightOptions {
  /** x y z of three corners per triangle, in model coordinates. */
  readonly corners: (state: SceneState) => readonly number[];
  /** The parts of the state that `corners` depends on. */
  readonly parts: readonly (keyof SceneState)[];
  readonly faceColor: (colors: ViewerColors) => string;
  readonly edgeColor: (colors: ViewerColors) => string;
}

/** Highlighted triangles: an element of the mesh, or defects of the boundary. They show through everything. */
export class HighlightLayer implements Layer {
  readonly root = new Group();
  readonly #options: HighlightOptions;
  readonly #plain = createFacetMaterial({ opacity: 0.9, depthWrite: true, polygonOffset: -2 });
  readonly #behind = createFacetMaterial({ opacity: 0.3, depthTest: false });
  readonly #edgeMaterial = new LineBasicMaterial({ transparent: true, depthTest: false });
  readonly #faces = [
    new Mesh(new BufferGeometry(), this.#plain),
    new Mesh(new BufferGeometry(), this.#behind),
  ] as const;
  readonly #edges = new LineSegments(new BufferGeometry(), this.#edgeMaterial);

  constructor(options: HighlightOptions) {
    this.#options = options;
    for (const [order, drawn] of [...this.#faces, this.#edges].entries()) {
      drawn.frustumCulled = false;
      drawn.renderOrder = 2 + 2 * order;
      this.root.add(drawn);
    }
  }

  update(changes: SceneChanges): void {
    const { corners, parts, faceColor, edgeColor } = this.#options;
    const { state } = changes;
    if (changes.has("colors")) {
      setColor(this.#plain, "color", faceColor(state.colors));
      setColor(this.#behind, "color", faceColor(state.colors));
      this.#edgeMaterial.color.set(edgeColor(state.colors));
    }
    if (changes.has("origin", ...parts)) this.#setTriangles(corners(state), state.origin);
  }

  dispose(): void {
    for (const { geometry } of [...this.#faces, this.#edges]) geometry.dispose();
    for (const material of [this.#plain, this.#behind, this.#edgeMaterial]) material.dispose();
  }

  #setTriangles(corners: readonly number[], origin: Position): void {
    const local = Float32Array.from(corners, (x, i) => x - (origin[i % 3] ?? 0));
    const position = new BufferAttribute(local, 3);
    // Edge k of a triangle joins its corners k and k + 1.
    const edges = Uint32Array.from({ length: (2 * local.length) / 3 }, (_, i) => {
      const [triangle, end] = [Math.floor(i / 6), i % 6];
      return 3 * triangle + (((end >> 1) + (end & 1)) % 3);
    });
    for (const { geometry } of [...this.#faces, this.#edges]) geometry.dispose();
    const faces = new BufferGeometry().setAttribute("position", position);
    for (const mesh of this.#faces) mesh.geometry = faces;
    this.#edges.geometry = new BufferGeometry()
      .setAttribute("position", position)
      .setIndex(new BufferAttribute(edges, 1));
    this.root.visible = local.length > 0;
  }
}
