import { BufferAttribute, BufferGeometry, Group, Mesh, Sphere, type Material } from "three";
import { createFacetMaterial } from "../materials/facet-material";
import { setColor } from "../materials/uniforms";
import type { Position } from "../../document/position";
import type { SceneChanges, SceneState } from "../scene-state";
import type { Layer } from "./layer";

/** Number of faces of a piece. Copying one, to its buffer and to the GPU, takes a few milliseconds. */
const maxFaces = 25_000;
/** A buffer that is too small grows by this factor. */
const growth = 1.5;
/** How strongly the front of an incomplete mesh shows through the elements that enclose it. */
const throughOpacity = 0.4;

/** Faces in model coordinates: x y z of three corners each, or three nodes each of `points`. */
interface Faces {
  readonly points: Float64Array;
  /** Null if the points are the corners. */
  readonly nodes: Uint32Array | null;
}

const countOf = ({ points, nodes }: Faces): number => (nodes ? nodes.length / 3 : points.length / 9);

interface Piece {
  geometry: BufferGeometry;
  readonly passes: readonly Mesh[];
}

/** Buffers of a front, in pieces. */
class FrontPieces {
  readonly #roots: readonly Group[];
  readonly #materials: readonly Material[];
  readonly #pieces: Piece[] = [];

  /** `roots` and `materials`: of each pass. */
  constructor(roots: readonly Group[], materials: readonly Material[]) {
    this.#roots = roots;
    this.#materials = materials;
  }

  /** Copies the faces of a piece to its buffer. They are not drawn yet. */
  write(index: number, faces: Faces, origin: Position): BufferGeometry {
    const { points, nodes } = faces;
    const first = 3 * maxFaces * index;
    const corners = Math.min(3 * countOf(faces), first + 3 * maxFaces) - first;
    const { geometry, position } = this.#withRoomFor(index, corners);
    const { array } = position;
    const [x, y, z] = origin;
    for (let i = 0; i < corners; i++) {
      const at = 3 * (nodes?.[first + i] ?? first + i);
      array[3 * i] = (points[at] ?? 0) - x;
      array[3 * i + 1] = (points[at + 1] ?? 0) - y;
      array[3 * i + 2] = (points[at + 2] ?? 0) - z;
    }
    position.clearUpdateRanges();
    position.addUpdateRange(0, 3 * corners);
    position.needsUpdate = true;
    return geometry;
  }

  /** Draws the first faces. */
  show(count: number): void {
    this.#pieces.forEach(({ geometry, passes }, p) => {
      const own = Math.min(Math.max(0, count - maxFaces * p), maxFaces);
      geometry.setDrawRange(0, 3 * own);
      for (const pass of passes) pass.visible = own > 0;
    });
  }

  dispose(): void {
    for (const { geometry } of this.#pieces) geometry.dispose();
  }

  #withRoomFor(index: number, corners: number): { geometry: BufferGeometry; position: BufferAttribute } {
    const piece = (this.#pieces[index] ??= this.#add());
    const position = piece.geometry.getAttribute("position") as BufferAttribute | undefined;
    if (position && position.count >= corners) return { geometry: piece.geometry, position };
    piece.geometry.dispose();
    const room = Math.min(Math.ceil(growth * corners), 3 * maxFaces);
    const made = new BufferAttribute(new Float32Array(3 * room), 3);
    piece.geometry.setAttribute("position", made);
    return { geometry: piece.geometry, position: made };
  }

  #add(): Piece {
    const geometry = new BufferGeometry();
    // Nothing is culled; without a sphere, the renderer would compute one from all corners.
    geometry.boundingSphere = new Sphere();
    const passes = this.#materials.map((material, pass) => {
      const mesh = new Mesh(geometry, material);
      mesh.frustumCulled = false;
      mesh.visible = false;
      this.#roots[pass]?.add(mesh);
      return mesh;
    });
    return { geometry, passes };
  }
}

interface Pending {
  readonly faces: Faces;
  readonly origin: Position;
}

/** What `prepareMore` has done: `shown` if another front is drawn from now on. */
export type Preparation = "nothing" | "piece" | "shown";

/**
 * The front of the current run as it advances, or the front that an incomplete mesh ends at, also behind its elements. A large
 * front is copied in pieces while the one before is drawn.
 */
export class FrontLayer implements Layer {
  readonly root = new Group();
  readonly #behind = new Group();
  readonly #material = createFacetMaterial({ opacity: 1, depthWrite: true, edges: true });
  readonly #through = createFacetMaterial({ opacity: throughOpacity, depthTest: false, edges: true });
  #shown = this.#makePieces();
  #next = this.#makePieces();
  /** The front that is copied, its next piece, and the one that has come meanwhile. */
  #pending: Pending | null = null;
  #piece = 0;
  #waiting: Pending | null = null;
  #count = 0;
  #isOn = true;

  constructor() {
    this.root.add(this.#behind);
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    if (changes.has("colors")) {
      for (const material of [this.#material, this.#through]) {
        setColor(material, "color", state.colors.front);
        setColor(material, "edgeColor", state.colors.meshEdge);
      }
    }
    if (changes.has("front", "mesh", "unoptimized", "isMeshOfOthers", "origin"))
      this.#take({ faces: facesOf(state), origin: state.origin });
    // While a run advances its front, no elements enclose it.
    this.#behind.visible = state.front === null;
    this.#isOn = state.layers.mesh;
    this.#show(this.#count);
  }

  /** Copies one more piece of a large front, and passes it to `upload`. */
  prepareMore(upload: (geometry: BufferGeometry) => void): Preparation {
    if (!this.#pending) return "nothing";
    const { faces, origin } = this.#pending;
    upload(this.#next.write(this.#piece, faces, origin));
    if (++this.#piece * maxFaces < countOf(faces)) return "piece";
    this.#shown.show(0);
    [this.#shown, this.#next] = [this.#next, this.#shown];
    this.#show(countOf(faces));
    this.#pending = this.#waiting;
    this.#waiting = null;
    this.#piece = 0;
    return "shown";
  }

  /** Number of faces that are drawn. */
  get count(): number {
    return this.#count;
  }

  dispose(): void {
    this.#shown.dispose();
    this.#next.dispose();
    this.#material.dispose();
    this.#through.dispose();
  }

  #take(pending: Pending): void {
    const count = countOf(pending.faces);
    if (count > maxFaces) {
      // A front that is copied is shown first: the next ones may come faster than they can be copied.
      if (this.#pending) this.#waiting = pending;
      else this.#pending = pending;
      return;
    }
    this.#pending = this.#waiting = null;
    this.#piece = 0;
    if (count > 0) this.#shown.write(0, pending.faces, pending.origin);
    this.#show(count);
  }

  #show(count: number): void {
    this.#count = count;
    this.#shown.show(count);
    this.root.visible = this.#isOn && count > 0;
  }

  #makePieces(): FrontPieces {
    return new FrontPieces([this.root, this.#behind], [this.#material, this.#through]);
  }
}

/** Returns the front of the run; without one, that at which an incomplete mesh ends, or its boundary if it has no tetrahedra. */
function facesOf({ front, mesh: result, unoptimized, isMeshOfOthers }: SceneState): Faces {
  if (front) return { points: front, nodes: null };
  const isIncomplete = result?.report.status === "stalled" || result?.report.status === "cancelled";
  if (!result || !isIncomplete || unoptimized !== null || isMeshOfOthers) return none;
  const { mesh } = result;
  return { points: mesh.points, nodes: mesh.tetrahedra.length === 0 ? mesh.triangles : result.front };
}

const none: Faces = { points: new Float64Array(), nodes: null };
