import { BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, type Ray } from "three";
import { setStateColors, setStateScale, stateCodes } from "../draw-state";
import { EntityStates } from "../entity-states";
import { createPatchMaterial } from "../materials/patch-material";
import type { Position } from "../../document/position";
import type { SampledProject, SceneChanges } from "../scene-state";
import type { Screen } from "../screen";
import { coarseTriangles, hurriedTriangles } from "../coarse-triangles";
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

/** States that the second and the third pass draw. */
const emphasis = ["hover", "selected", "defective"] as const;
const emphasisCodes: ReadonlySet<number> = new Set(emphasis.map((state) => stateCodes[state]));

/**
 * The model's patches as sampled by the engine, drawn by three passes. The nodes of a patch are vertices of its own, which
 * carry its state.
 */
export class PatchesLayer implements HittableLayer {
  readonly root = new Group();
  readonly #states = new EntityStates("patch", { tinted: true });
  readonly #geometry = new BufferGeometry();
  /** The same vertices, with the triangles of emphasized patches only. */
  readonly #emphasizedGeometry = new BufferGeometry();
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
  /** All patches in one pass, with fewer triangles, while a motion must hurry. */
  readonly #hurried = createPatchMaterial({
    opacities: { normal: opacityAlone, hover: 0.6, selected: 0.65, defective: 0.85 },
    polygonOffset: 2,
  });
  readonly #coarseGeometry = new BufferGeometry();
  /** Whether the coarse triangles belong to these vertices. */
  #isCoarse = false;
  readonly #coarse = new Mesh(this.#coarseGeometry, this.#hurried);
  readonly #meshes = [
    new Mesh(this.#geometry, this.#plain),
    new Mesh(this.#emphasizedGeometry, this.#emphasized),
    new Mesh(this.#emphasizedGeometry, this.#behind),
  ] as const;
  #vertices: PatchVertices = noVertices;
  /** First triangle of each patch, and the end. */
  #offsets: ArrayLike<number> = [0];
  #tree = new TriangleTree(new Float32Array());
  #origin: Position = [0, 0, 0];
  readonly #buildTree: BuildTree;

  /** @param buildTree builds trees for hit tests in a worker. */
  constructor(buildTree: BuildTree) {
    this.#buildTree = buildTree;
    this.#allocate();
    this.#coarse.frustumCulled = false;
    this.#coarse.renderOrder = 1;
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
      setStateColors(this.#hurried, { normal: patch, hover, selected, defective });
    }
    if (changes.has("layers", "mesh", "front")) {
      // A closed front has no faces; only the patches are then drawn.
      const hasMesh = (state.front ?? (state.unoptimized ?? state.mesh)?.volume.tetrahedra ?? []).length > 0;
      const opacity = state.layers.mesh && hasMesh ? opacityOverMesh : opacityAlone;
      for (const drawn of ["normal", "hover", "selected", "defective"] as const) {
        setStateScale(this.#plain, drawn, opacity);
      }
      setStateScale(this.#hurried, "normal", opacity);
    }
    if (changes.has("preview", "origin")) this.#setPositions(state.preview, state.origin);
    this.#states.update(state);
    if (changes.has("preview", "origin", "hover", "selection", "hidden", "defects")) this.#setEmphasized();
    const [plain, emphasized, behind] = this.#meshes;
    emphasized.visible = this.#states.hasAny(...emphasis);
    behind.visible = this.#states.hasAny("selected", "defective");
    plain.visible = emphasized.visible || this.#states.hasAny("normal");
    this.#coarse.visible = state.viewport.isHurried && plain.visible;
    if (!this.#coarse.visible) return;
    this.#makeCoarse();
    for (const mesh of this.#meshes) mesh.visible = false;
  }

  hit(ray: Ray, screen: Screen): Hit | null {
    if (!this.root.visible) return null;
    const { index } = this.#vertices;
    const vertexOf = (triangle: number): number => index[3 * triangle] ?? 0;
    const hit = this.#tree.firstHit(ray, DoubleSide, (triangle) =>
      this.#states.canHit(vertexOf(triangle), screen),
    );
    const target = hit && this.#states.entityAt(this.#states.recordOf(vertexOf(hit.triangle)));
    if (!target || hit.distance > screen.maxDepth) return null;
    return { target, position: addOrigin(hit.point, this.#origin), depth: hit.distance };
  }

  dispose(): void {
    this.#geometry.dispose();
    this.#emphasizedGeometry.dispose();
    this.#coarseGeometry.dispose();
    for (const { material } of [...this.#meshes, this.#coarse]) material.dispose();
  }

  #setPositions(preview: SampledProject | null, origin: Position): void {
    const empty = { patchOffsets: [0], patchTriangles: [], patchPoints: [] };
    const { patchOffsets, patchTriangles, patchPoints } = preview?.samples ?? empty;
    const before = this.#vertices;
    this.#origin = origin;
    this.#offsets = patchOffsets;
    this.#vertices = verticesOf(patchOffsets, patchTriangles, patchPoints.length / 3);
    const { nodes, index, offsets } = this.#vertices;
    this.#states.assign(preview?.project.patches ?? [], offsets);
    if (nodes.length !== before.nodes.length || index.length !== before.index.length) this.#allocate();
    this.#copyIndex();
    const positions = this.#geometry.getAttribute("position") as BufferAttribute;
    nodes.forEach((node, vertex) => {
      for (let k = 0; k < 3; ++k)
        positions.array[3 * vertex + k] = (patchPoints[3 * node + k] ?? 0) - (origin[k] ?? 0);
    });
    positions.needsUpdate = true;
    const corners = new Float32Array(3 * index.length);
    index.forEach((vertex, corner) => {
      for (let k = 0; k < 3; ++k) corners[3 * corner + k] = positions.array[3 * vertex + k] ?? 0;
    });
    this.#tree = new TriangleTree(corners);
    if (this.root.visible) void this.#tree.prepare(this.#buildTree);
  }

  /** Gives all geometries new attributes: the number of vertices or triangles has changed. */
  #allocate(): void {
    const { nodes, index } = this.#vertices;
    const positions = new BufferAttribute(new Float32Array(3 * nodes.length), 3);
    for (const geometry of [this.#geometry, this.#emphasizedGeometry, this.#coarseGeometry]) {
      geometry.dispose();
      geometry.setAttribute("position", positions);
      // The coarse triangles are made when they are needed.
      const hasIndex = geometry !== this.#coarseGeometry;
      geometry.setIndex(hasIndex ? new BufferAttribute(new Uint32Array(index.length), 1) : null);
      this.#states.attachTo(geometry);
    }
    this.#isCoarse = false;
  }

  /**
   * Writes the coarse triangles if they have changed. Their geometry is not disposed: this would delete the attributes that it
   * shares with the others.
   */
  #makeCoarse(): void {
    if (this.#isCoarse) return;
    this.#isCoarse = true;
    this.root.add(this.#coarse);
    const { array: positions } = this.#geometry.getAttribute("position");
    const { index } = this.#vertices;
    const coarse = coarseTriangles({ positions, index, offsets: this.#offsets }, hurriedTriangles);
    const drawn = this.#coarseGeometry.getIndex() ?? new BufferAttribute(new Uint32Array(index.length), 1);
    this.#coarseGeometry.setIndex(drawn);
    drawn.array.set(coarse);
    drawFirst(this.#coarseGeometry, drawn, coarse.length);
  }

  #copyIndex(): void {
    const drawn = this.#geometry.getIndex();
    if (!drawn || drawn.array.every((vertex, corner) => vertex === this.#vertices.index[corner])) return;
    drawn.array.set(this.#vertices.index);
    drawn.needsUpdate = true;
    this.#isCoarse = false;
  }

  #setEmphasized(): void {
    const drawn = this.#emphasizedGeometry.getIndex();
    if (!drawn) return;
    let count = 0;
    for (let patch = 0; patch + 1 < this.#offsets.length; ++patch) {
      if (!emphasisCodes.has(this.#states.codeAt(patch))) continue;
      const corners = this.#vertices.index.subarray(
        3 * (this.#offsets[patch] ?? 0),
        3 * (this.#offsets[patch + 1] ?? 0),
      );
      drawn.array.set(corners, count);
      count += corners.length;
    }
    drawFirst(this.#emphasizedGeometry, drawn, count);
  }
}

/** Draws the first entries of an index, which have changed. */
function drawFirst(geometry: BufferGeometry, index: BufferAttribute, count: number): void {
  geometry.setDrawRange(0, count);
  index.clearUpdateRanges();
  index.addUpdateRange(0, count);
  index.needsUpdate = true;
}

interface PatchVertices {
  /** Node of each vertex. */
  readonly nodes: readonly number[];
  /** Three vertices per triangle. */
  readonly index: Uint32Array;
  /** First vertex of each patch, and the end. */
  readonly offsets: Uint32Array;
}

const noVertices: PatchVertices = { nodes: [], index: new Uint32Array(), offsets: new Uint32Array(1) };

/** Makes a vertex of each node of each patch: patches share the nodes along lines. */
function verticesOf(
  triangleOffsets: ArrayLike<number>,
  triangles: ArrayLike<number>,
  nodeCount: number,
): PatchVertices {
  const nodes: number[] = [];
  const index = new Uint32Array(triangles.length);
  const offsets = new Uint32Array(triangleOffsets.length);
  const vertexOf = new Int32Array(nodeCount).fill(-1);
  for (let patch = 0; patch + 1 < triangleOffsets.length; ++patch) {
    const first = nodes.length;
    for (
      let corner = 3 * (triangleOffsets[patch] ?? 0);
      corner < 3 * (triangleOffsets[patch + 1] ?? 0);
      ++corner
    ) {
      const node = triangles[corner] ?? 0;
      // A vertex from before is that of another patch.
      if ((vertexOf[node] ?? -1) < first) vertexOf[node] = nodes.push(node) - 1;
      index[corner] = vertexOf[node] ?? 0;
    }
    offsets[patch + 1] = nodes.length;
  }
  return { nodes, index, offsets };
}
