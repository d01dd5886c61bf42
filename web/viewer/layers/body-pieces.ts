import { BufferAttribute, BufferGeometry, Mesh, Sphere, Vector3, type Group, type Material } from "three";
import type { DrawnSurface } from "../../document/drawn-surface";

/** Number of triangles of a piece. The first drawing of a piece copies it to the GPU, which takes some milliseconds. */
const maxTriangles = 100_000;

/** Passes in the order of drawing: the triangles, emphasized patches, and emphasized patches behind other surfaces. */
const passCount = 3;

interface Piece {
  readonly passes: readonly Mesh[];
  readonly geometry: BufferGeometry;
  /** Range of its vertices. */
  readonly first: number;
  readonly end: number;
}

/** Copies to the GPU what has changed in the states of a piece. `ranges`: ranges of vertices of the surface. */
function updateStates({ geometry, first, end }: Piece, ranges: BufferAttribute["updateRanges"]): void {
  const states = geometry.getAttribute("state") as BufferAttribute;
  for (const { start, count } of ranges) {
    const from = Math.max(start, first);
    const to = Math.min(start + count, end);
    if (from >= to) continue;
    states.addUpdateRange(from - first, to - from);
    states.needsUpdate = true;
  }
}

/** Draws the triangles of a surface in pieces. Each frame adds one piece, so that no frame takes long. */
export class BodyPieces {
  readonly #root: Group;
  #pieces: readonly Piece[] = [];
  #drawnPieces = 0;
  /** The states shown, and their version. */
  #states: BufferAttribute | null = null;
  #version = -1;

  constructor(root: Group) {
    this.#root = root;
  }

  /** Whether all pieces are drawn. */
  get isComplete(): boolean {
    return this.#drawnPieces >= this.#pieces.length;
  }

  /** Replaces the triangles. */
  setTriangles(
    { corners, values, hiddenEdges, low, high }: DrawnSurface,
    materials: readonly Material[],
  ): void {
    this.dispose();
    const radius = Math.hypot(...high.map((x, k) => (x - (low[k] ?? 0)) / 2));
    const triangles = corners.length / 9;
    const count = Math.max(1, Math.ceil(triangles / maxTriangles));
    this.#pieces = Array.from({ length: count }, (_, p) => {
      const [from, to] = [p, p + 1].map((k) => Math.floor((k * triangles) / count)) as [number, number];
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(corners.subarray(9 * from, 9 * to), 3));
      if (hiddenEdges)
        geometry.setAttribute("hiddenEdges", new BufferAttribute(hiddenEdges.subarray(3 * from, 3 * to), 1));
      if (values) geometry.setAttribute("value", new BufferAttribute(values.subarray(3 * from, 3 * to), 1));
      // The renderer would compute it from all corners.
      geometry.boundingSphere = new Sphere(new Vector3(), radius);
      const passes = Array.from({ length: passCount }, (_pass, pass) => {
        const mesh = new Mesh(geometry, materials[pass]);
        mesh.frustumCulled = false;
        mesh.renderOrder = pass === 0 ? 0 : 1 + pass;
        return mesh;
      });
      return { passes, geometry, first: 3 * from, end: 3 * to };
    });
    for (const { passes } of this.#pieces) this.#root.add(...passes);
    this.#drawnPieces = 1;
    this.#states = null;
  }

  setMaterial(material: Material): void {
    for (const { passes } of this.#pieces) if (passes[0]) passes[0].material = material;
  }

  /** Shows the states of the vertices, and draws some of the passes. */
  show(states: BufferAttribute, visible: readonly boolean[]): void {
    if (states !== this.#states) {
      for (const { geometry, first, end } of this.#pieces) {
        geometry.setAttribute("state", new BufferAttribute(states.array.subarray(first, end), 1));
      }
    } else if (states.version !== this.#version) {
      for (const piece of this.#pieces) updateStates(piece, states.updateRanges);
    }
    // The attributes of the pieces are copied to the GPU, never this one.
    states.clearUpdateRanges();
    this.#states = states;
    this.#version = states.version;
    this.#pieces.forEach(({ passes }, p) => {
      passes.forEach((pass, k) => (pass.visible = visible[k] === true && p < this.#drawnPieces));
    });
  }

  /** Draws one more piece in the next frame. Returns whether there was one. */
  drawMore(): boolean {
    if (this.isComplete) return false;
    const [shown, next] = [this.#pieces[0], this.#pieces[this.#drawnPieces++]];
    next?.passes.forEach((pass, k) => (pass.visible = shown?.passes[k]?.visible === true));
    return true;
  }

  dispose(): void {
    for (const { passes, geometry } of this.#pieces) {
      this.#root.remove(...passes);
      geometry.dispose();
    }
    this.#pieces = [];
  }
}
