import type { ProjectPreview } from "tetrafront";
import { BufferAttribute, BufferGeometry, Group, Mesh } from "three";
import type { ViewerColors } from "../colors";
import { createFacetMaterial, setColor, setNumber } from "../materials";
import type { Position, SceneLayer } from "./layer";

type Marking = "normal" | "faulty" | "hover" | "selected";

/** Over a mesh the patches are only a hint of the hull; alone they are the model. */
const opacityOverMesh = 0.14;
const opacityAlone = 0.42;
const opacityThrough = 0.16;

type FacetMesh = Mesh<BufferGeometry, ReturnType<typeof createFacetMaterial>>;

/** The model's patches as sampled by the engine; marked ones are drawn again in their colour. */
export class PatchesLayer implements SceneLayer {
  readonly root = new Group();
  readonly #meshes: { readonly [M in Marking]: FacetMesh };
  /** These patches once more, faintly, where something lies before them. */
  readonly #through: { readonly [M in "faulty" | "selected"]: FacetMesh };
  #position = new BufferAttribute(new Float32Array(), 3);
  #preview: ProjectPreview | null = null;
  #drawnPatches: number[] = [];

  constructor() {
    const create = (opacity: number, polygonOffset: number, renderOrder: number) => {
      const mesh = new Mesh(new BufferGeometry(), createFacetMaterial({ opacity, polygonOffset }));
      mesh.frustumCulled = false;
      mesh.renderOrder = renderOrder;
      return mesh;
    };
    this.#meshes = {
      // Behind the mesh, where both lie in one plane.
      normal: create(opacityAlone, 2, 1),
      faulty: create(0.8, -1, 2),
      hover: create(0.35, -1, 2),
      selected: create(0.5, -1, 2),
    };
    const createThrough = () => {
      const material = createFacetMaterial({ opacity: opacityThrough, depthTest: false });
      const mesh = new Mesh(new BufferGeometry(), material);
      mesh.frustumCulled = false;
      mesh.renderOrder = 3;
      return mesh;
    };
    this.#through = { faulty: createThrough(), selected: createThrough() };
    this.root.add(...Object.values(this.#meshes), ...Object.values(this.#through));
  }

  setColors(colors: ViewerColors): void {
    setColor(this.#meshes.normal.material, "color", colors.patch);
    setColor(this.#meshes.hover.material, "color", colors.hover);
    setColor(this.#meshes.selected.material, "color", colors.selection);
    setColor(this.#meshes.faulty.material, "color", colors.front);
    setColor(this.#through.selected.material, "color", colors.selection);
    setColor(this.#through.faulty.material, "color", colors.front);
  }

  setOverMesh(overMesh: boolean): void {
    setNumber(this.#meshes.normal.material, "opacity", overMesh ? opacityOverMesh : opacityAlone);
  }

  setPreview(preview: ProjectPreview | null, origin: Position): void {
    this.#preview = preview;
    const places = Float32Array.from(preview?.patchPoints ?? [], (x, i) => x - (origin[i % 3] ?? 0));
    this.#position = new BufferAttribute(places, 3);
  }

  /** Rebuilds the triangles drawn. `markingOf` tells how to draw the patch at a position; null hides it. */
  update(markingOf: (position: number) => Marking | null): void {
    const triangles: Record<Marking, number[]> = { normal: [], faulty: [], hover: [], selected: [] };
    this.#drawnPatches = [];
    const patchCount = (this.#preview?.patchOffsets.length ?? 1) - 1;
    for (let position = 0; position < patchCount; ++position) {
      const marking = markingOf(position);
      if (!marking) continue;
      const range = this.#rangeOf(position);
      for (const node of range) triangles.normal.push(node);
      if (marking !== "normal") for (const node of range) triangles[marking].push(node);
      for (let t = 0; t < range.length / 3; ++t) this.#drawnPatches.push(position);
    }
    for (const marking of ["normal", "faulty", "hover", "selected"] as const) {
      const mesh = this.#meshes[marking];
      mesh.geometry.dispose();
      mesh.geometry = new BufferGeometry().setAttribute("position", this.#position);
      mesh.geometry.setIndex(new BufferAttribute(Uint32Array.from(triangles[marking]), 1));
      mesh.visible = triangles[marking].length > 0;
    }
    for (const marking of ["faulty", "selected"] as const) {
      this.#through[marking].geometry = this.#meshes[marking].geometry;
      this.#through[marking].visible = this.#meshes[marking].visible;
    }
  }

  /** For picking: the triangles of all patches drawn; null without any. */
  get geometry(): BufferGeometry | null {
    return this.#drawnPatches.length > 0 ? this.#meshes.normal.geometry : null;
  }

  /** The position of the patch that a drawn triangle belongs to. */
  patchOf(triangle: number): number | null {
    return this.#drawnPatches[triangle] ?? null;
  }

  dispose(): void {
    for (const mesh of Object.values(this.#meshes)) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    for (const { material } of Object.values(this.#through)) material.dispose();
  }

  #rangeOf(position: number): Uint32Array {
    if (!this.#preview) return new Uint32Array();
    const { patchOffsets, patchTriangles } = this.#preview;
    return patchTriangles.subarray(3 * (patchOffsets[position] ?? 0), 3 * (patchOffsets[position + 1] ?? 0));
  }
}
