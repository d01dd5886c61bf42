import { BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, type Ray } from "three";
import { setStateColors, setStateScale, stateCodes } from "../draw-state";
import { EntityStates } from "../entity-states";
import { createPatchMaterial } from "../materials/patch-material";
import type { Position } from "../../document/position";
import { showsFaces, type SampledProject, type SceneChanges } from "../scene-state";
import type { Screen } from "../screen";
import { CoarseTriangles, hurriedTriangles } from "../coarse-triangles";
import { drawFirst } from "../draw-first";
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

/** Positions that have not changed for this time are at rest, in milliseconds. */
const restMs = 250;

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
  readonly #coarseTriangles = new CoarseTriangles(hurriedTriangles);
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
  /** The sampled triangles that the vertices were made of. */
  #triangles: ArrayLike<number> = [];
  /** For hit tests; null until the first one after a change. */
  #tree: TriangleTree | null = null;
  #treeTimer: ReturnType<typeof setTimeout> | undefined;
  #changedAt = -Infinity;
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
    if (changes.has("layers", "mesh", "unoptimized", "front", "isMeshOfOthers")) {
      const opacity = showsFaces(state) ? opacityOverMesh : opacityAlone;
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
    const hit = this.#treeOfCorners().firstHit(ray, DoubleSide, (triangle) =>
      this.#states.canHit(vertexOf(triangle), screen),
    );
    const target = hit && this.#states.entityAt(this.#states.recordOf(vertexOf(hit.triangle)));
    if (!target || hit.distance > screen.maxDepth) return null;
    return { target, position: addOrigin(hit.point, this.#origin), depth: hit.distance };
  }

  dispose(): void {
    clearTimeout(this.#treeTimer);
    this.#geometry.dispose();
    this.#emphasizedGeometry.dispose();
    this.#coarseGeometry.dispose();
    for (const { material } of [...this.#meshes, this.#coarse]) material.dispose();
  }

  #setPositions(preview: SampledProject | null, origin: Position): void {
    const empty = { patchOffsets: [0], patchTriangles: [], patchPoints: [] };
    const { patchOffsets, patchTriangles, patchPoints } = preview?.samples ?? empty;
    this.#origin = origin;
    if (!isSame(patchOffsets, this.#offsets) || !isSame(patchTriangles, this.#triangles)) {
      const before = this.#vertices;
      this.#offsets = patchOffsets;
      this.#triangles = patchTriangles;
      this.#vertices = verticesOf(patchOffsets, patchTriangles, patchPoints.length / 3);
      const { nodes, index } = this.#vertices;
      this.#states.assign(preview?.project.patches ?? [], this.#vertices.offsets);
      if (nodes.length !== before.nodes.length || index.length !== before.index.length) this.#allocate();
      this.#copyIndex();
    } else this.#states.assign(preview?.project.patches ?? [], this.#vertices.offsets);
    const { nodes } = this.#vertices;
    const positions = this.#geometry.getAttribute("position") as BufferAttribute;
    for (let vertex = 0; vertex < nodes.length; ++vertex) {
      const node = nodes[vertex] ?? 0;
      for (let k = 0; k < 3; ++k)
        positions.array[3 * vertex + k] = (patchPoints[3 * node + k] ?? 0) - (origin[k] ?? 0);
    }
    positions.needsUpdate = true;
    this.#dropTree();
  }

  /** Lets a worker build a tree of the new positions, unless others follow soon: nothing is hit while something moves. */
  #dropTree(): void {
    clearTimeout(this.#treeTimer);
    this.#tree = null;
    const now = performance.now();
    const isMoving = now - this.#changedAt < restMs;
    this.#changedAt = now;
    const prepare = (): void => void this.#treeOfCorners().prepare(this.#buildTree);
    if (!this.root.visible) return;
    if (isMoving) this.#treeTimer = setTimeout(prepare, restMs);
    else prepare();
  }

  #treeOfCorners(): TriangleTree {
    if (this.#tree) return this.#tree;
    const { array } = this.#geometry.getAttribute("position");
    const { index } = this.#vertices;
    const corners = new Float32Array(3 * index.length);
    for (let corner = 0; corner < index.length; ++corner) {
      const vertex = index[corner] ?? 0;
      for (let k = 0; k < 3; ++k) corners[3 * corner + k] = array[3 * vertex + k] ?? 0;
    }
    return (this.#tree = new TriangleTree(corners));
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
    const coarse = this.#coarseTriangles.of({ positions, index, offsets: this.#offsets });
    const drawn = this.#coarseGeometry.getIndex() ?? new BufferAttribute(new Uint32Array(index.length), 1);
    this.#coarseGeometry.setIndex(drawn);
    drawn.array.set(coarse);
    drawFirst(this.#coarseGeometry, coarse.length);
  }

  #copyIndex(): void {
    const drawn = this.#geometry.getIndex();
    if (!drawn || isSame(drawn.array, this.#vertices.index)) return;
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
    drawFirst(this.#emphasizedGeometry, count);
  }
}

function isSame(a: ArrayLike<number>, b: ArrayLike<number>): boolean {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; ++i) if (a[i] !== b[i]) return false;
  return true;
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
