import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Mesh } from "three";
import type { Position } from "../../document/position";
import { createFacetMaterial } from "../materials/facet-material";
import { setColor } from "../materials/uniforms";
import { drawsFieldShapes, type SceneChanges } from "../scene-state";
import type { Layer } from "./layer";

/** An isosurface, x y z of three corners per triangle, and its colour; positions are relative to `origin`. */
export interface DrawnIsosurface {
  readonly corners: Float32Array<ArrayBuffer>;
  readonly origin: Position;
  readonly color: string;
}

/** What shows a field inside the mesh: an isosurface, and arrows of vectors. */
export class FieldLayer implements Layer {
  readonly root = new Group();
  readonly #faceMaterial = createFacetMaterial({ opacity: 1, depthWrite: true });
  readonly #lineMaterial = new LineBasicMaterial();
  readonly #faces = new Mesh(new BufferGeometry(), this.#faceMaterial);
  readonly #lines = new LineSegments(new BufferGeometry(), this.#lineMaterial);
  #origin: Position = [0, 0, 0];
  #isosurface: DrawnIsosurface | null = null;
  /** Ends of segments in model coordinates. */
  #arrows: Float64Array = new Float64Array();

  constructor() {
    for (const drawn of [this.#faces, this.#lines]) {
      drawn.frustumCulled = false;
      this.root.add(drawn);
    }
  }

  /** Position to which an isosurface should be relative. */
  get origin(): Position {
    return this.#origin;
  }

  setIsosurface(isosurface: DrawnIsosurface | null): void {
    this.#isosurface = isosurface;
    this.#faces.visible = isosurface !== null;
    if (!isosurface) return;
    setColor(this.#faceMaterial, "color", isosurface.color);
    this.#faces.geometry.dispose();
    const position = new BufferAttribute(isosurface.corners, 3);
    this.#faces.geometry = new BufferGeometry().setAttribute("position", position);
    this.#move();
  }

  setArrows(ends: Float64Array): void {
    this.#arrows = ends;
    this.#writeArrows();
  }

  update(changes: SceneChanges): void {
    const { colors, origin } = changes.state;
    this.root.visible = drawsFieldShapes(changes.state);
    if (changes.has("colors")) this.#lineMaterial.color.set(colors.line);
    if (!changes.has("origin")) return;
    this.#origin = origin;
    this.#move();
    this.#writeArrows();
  }

  dispose(): void {
    for (const { geometry, material } of [this.#faces, this.#lines]) {
      geometry.dispose();
      material.dispose();
    }
  }

  #move(): void {
    const from = this.#isosurface?.origin ?? this.#origin;
    this.#faces.position.set(
      ...(from.map((x, axis) => x - (this.#origin[axis] ?? 0)) as [number, number, number]),
    );
  }

  #writeArrows(): void {
    const local = Float32Array.from(this.#arrows, (x, i) => x - (this.#origin[i % 3] ?? 0));
    this.#lines.visible = local.length > 0;
    this.#lines.geometry.dispose();
    this.#lines.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(local, 3));
  }
}
