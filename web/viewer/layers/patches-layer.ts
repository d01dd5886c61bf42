import { BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, type Ray } from "three";
import { setStateColors, setStateScale } from "../draw-state";
import { EntityStates } from "../entity-states";
import { createPatchMaterial } from "../materials/patch-material";
import type { Position } from "../../document/position";
import type { SampledProject, SceneChanges } from "../scene-state";
import type { Screen } from "../screen";
import { TriangleTree, type SerializedTree } from "../triangle-tree";
import { addOrigin, type Hit, type HittableLayer } from "./layer";

/**
 * In front of a mesh, the patches are faint and only indicate the boundary; without a mesh, they show the
 * model.
 */
const opacityOverMesh = 0.14;
const opacityAlone = 0.42;
/** Behind other surfaces. */
const opacityBehind = 0.16;

type BuildTree = (corners: Float32Array<ArrayBuffer>) => Promise<SerializedTree>;

/** The model's patches as sampled by the engine: one buffer of triangles, drawn by three passes. */
export class PatchesLayer implements HittableLayer {
  readonly root = new Group();
  readonly #states = new EntityStates("patch", { tinted: true });
  readonly #geometry = new BufferGeometry();
  /** All patches, behind the mesh if both lie in one plane. */
  readonly #plain = createPatchMaterial({
    opacities: {
      normal: opacityAlone,
      hover: opacityAlone,
      selected: opacityAlone,
      defective: opacityAlone,
    },
    polygonOffset: 2,
  });
  readonly #emphasized = createPatchMaterial({
    opacities: { hover: 0.35, selected: 0.5, defective: 0.8 },
    polygonOffset: -1,
  });
  /** Selected and defective patches show through everything in front of them. */
  readonly #behind = createPatchMaterial({
    opacities: { selected: opacityBehind, defective: opacityBehind },
    depthTest: false,
  });
  readonly #meshes = [
    new Mesh(this.#geometry, this.#plain),
    new Mesh(this.#geometry, this.#emphasized),
    new Mesh(this.#geometry, this.#behind),
  ] as const;
  /** x y z of three corners per triangle, local. */
  #corners = new Float32Array();
  #tree = new TriangleTree(this.#corners);
  #origin: Position = [0, 0, 0];
  readonly #buildTree: BuildTree;

  /** @param buildTree builds trees for hit tests in a worker. */
  constructor(buildTree: BuildTree) {
    this.#buildTree = buildTree;
    this.#meshes.forEach((mesh, pass) => {
      mesh.frustumCulled = false;
      mesh.renderOrder = 1 + pass;
      this.root.add(mesh);
    });
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    this.root.visible = state.layers.patches;
    if (changes.has("colors")) {
      const { patch, hover, selection: selected, front: defective } = state.colors;
      setStateColors(this.#plain, { normal: patch, hover: patch, selected: patch, defective: patch });
      for (const material of [this.#emphasized, this.#behind]) {
        setStateColors(material, { hover, selected, defective });
      }
    }
    if (changes.has("layers", "mesh", "front")) {
      // A closed front has no faces; only the patches are then drawn.
      const hasMesh = (state.front ?? (state.unoptimized ?? state.mesh)?.volume.tetrahedra ?? []).length > 0;
      const opacity = state.layers.mesh && hasMesh ? opacityOverMesh : opacityAlone;
      for (const drawn of ["normal", "hover", "selected", "defective"] as const) {
        setStateScale(this.#plain, drawn, opacity);
      }
    }
    if (changes.has("preview", "origin")) this.#setPositions(state.preview, state.origin);
    this.#states.update(state);
    const [plain, emphasized, behind] = this.#meshes;
    emphasized.visible = this.#states.hasAny("hover", "selected", "defective");
    behind.visible = this.#states.hasAny("selected", "defective");
    plain.visible = emphasized.visible || this.#states.hasAny("normal");
  }

  hit(ray: Ray, screen: Screen): Hit | null {
    if (!this.root.visible) return null;
    const hit = this.#tree.firstHit(ray, DoubleSide, (triangle) => this.#states.canHit(3 * triangle, screen));
    const target = hit && this.#states.entityAt(this.#states.recordOf(3 * hit.triangle));
    if (!target || hit.distance > screen.maxDepth) return null;
    return { target, position: addOrigin(hit.point, this.#origin), depth: hit.distance };
  }

  dispose(): void {
    this.#geometry.dispose();
    for (const { material } of this.#meshes) material.dispose();
  }

  #setPositions(preview: SampledProject | null, origin: Position): void {
    const empty = { patchOffsets: [0], patchTriangles: [], patchPoints: [] };
    const { patchOffsets, patchTriangles, patchPoints } = preview?.samples ?? empty;
    this.#origin = origin;
    this.#states.assign(
      preview?.project.patches ?? [],
      Uint32Array.from(patchOffsets, (triangle) => 3 * triangle),
    );
    if (3 * patchTriangles.length !== this.#corners.length) this.#allocate(patchTriangles.length);
    // Patches share nodes along lines. Each gets its own corners, which carry its state.
    for (let corner = 0; corner < patchTriangles.length; ++corner) {
      const node = 3 * (patchTriangles[corner] ?? 0);
      for (let k = 0; k < 3; ++k)
        this.#corners[3 * corner + k] = (patchPoints[node + k] ?? 0) - (origin[k] ?? 0);
    }
    this.#tree = new TriangleTree(this.#corners);
    if (this.root.visible) void this.#tree.prepare(this.#buildTree);
    const position = this.#geometry.getAttribute("position") as BufferAttribute | undefined;
    if (position) position.needsUpdate = true;
  }

  #allocate(corners: number): void {
    this.#geometry.dispose();
    this.#corners = new Float32Array(3 * corners);
    this.#geometry.setAttribute("position", new BufferAttribute(this.#corners, 3));
    this.#states.attachTo(this.#geometry);
  }
}
