import type { MeshResult, VolumeMesh } from "tetrafront";
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  Mesh,
  type DataTexture,
} from "three";
import { placeOnScale, qualityOf } from "../../document/mesh-quality";
import type { Cut, CutAxis, Shading } from "../../document/selection";
import type { ViewerColors } from "../colors";
import { createFacetMaterial, createMeshMaterial, rampTexture, setColor, setNumber } from "../materials";
import { faceNodes, findNeighbours } from "../topology";
import { centroidsAlong, collectVisibleFaces, extentAlong, writeCorners } from "../visible-faces";
import type { Place, SceneLayer } from "./layer";

/** How far an out-of-date mesh fades towards the background. */
const staleFading = 0.62;

/** The tetrahedra: the boundary, or what a cut leaves of it, and the front of an incomplete mesh. */
export class MeshLayer implements SceneLayer {
  readonly root = new Group();
  readonly #material = createMeshMaterial();
  readonly #frontMaterial = createFacetMaterial({ opacity: 1, depthWrite: true });
  readonly #mesh = new Mesh(new BufferGeometry(), this.#material);
  readonly #front = new Mesh(new BufferGeometry(), this.#frontMaterial);
  #ramp: DataTexture | null = null;
  #volume: VolumeMesh | null = null;
  #neighbours: Int32Array = new Int32Array();
  #origin: Place = [0, 0, 0];
  #faces = new Uint32Array();
  #faceCount = 0;
  #outdated = false;
  #cut: Cut | null = null;
  #shading: Shading = "radius-ratio";
  readonly #centroids = new Map<CutAxis, Float32Array>();
  readonly #extents = new Map<CutAxis, readonly [number, number]>();

  constructor() {
    this.root.add(this.#mesh, this.#front);
    for (const mesh of [this.#mesh, this.#front]) mesh.frustumCulled = false;
  }

  setColors(colors: ViewerColors): void {
    this.#ramp?.dispose();
    this.#ramp = rampTexture(colors.ramp);
    const { ramp } = this.#material.uniforms;
    if (ramp) ramp.value = this.#ramp;
    setColor(this.#material, "plainColor", colors.meshPlain);
    setColor(this.#material, "edgeColor", colors.meshEdge);
    setColor(this.#material, "fadedColor", colors.faded);
    setColor(this.#frontMaterial, "color", colors.front);
  }

  /** Shows another mesh, or none. Finding the neighbours costs about 50 ms per 100 000 tetrahedra. */
  setMesh(result: MeshResult | null, origin: Place): void {
    this.#volume = result?.volume ?? null;
    this.#origin = origin;
    this.#centroids.clear();
    this.#extents.clear();
    this.#neighbours = this.#volume ? findNeighbours(this.#volume.tetrahedra) : new Int32Array();
    // A sheet is drawn once per side, so every face may become visible.
    this.#faces = new Uint32Array(this.#neighbours.length);
    this.#outdated = true;
    this.#showFront(result);
  }

  setCut(cut: Cut): void {
    this.#cut = cut;
    this.#outdated = true;
  }

  /** Brings the drawn faces up to date: once per frame, however often the cut has moved. */
  refresh(): void {
    if (!this.#outdated) return;
    this.#outdated = false;
    this.#rebuild();
  }

  setShading(shading: Shading, edges: boolean): void {
    setNumber(this.#material, "edges", edges ? 1 : 0);
    setNumber(this.#material, "shaded", shading === "plain" ? 0 : 1);
    if (shading === this.#shading) return;
    this.#shading = shading;
    this.#outdated = true;
  }

  setStale(stale: boolean): void {
    setNumber(this.#material, "fading", stale ? staleFading : 0);
  }

  /** Number of tetrahedra in the mesh, and of faces drawn of them. */
  get counts(): { readonly tetrahedra: number; readonly drawnFaces: number } {
    this.refresh();
    return { tetrahedra: (this.#volume?.tetrahedra.length ?? 0) / 4, drawnFaces: this.#faceCount };
  }

  get drawn(): Mesh {
    this.refresh();
    return this.#mesh;
  }

  /** The tetrahedron, its face and whether the face is the mesh's boundary, of a drawn triangle. */
  faceAt(triangle: number): { tetrahedron: number; nodes: number[]; onBoundary: boolean } | null {
    if (!this.#volume || triangle >= this.#faceCount) return null;
    const face = this.#faces[triangle] ?? 0;
    const local = 3 * (face & 3);
    const nodes = [0, 1, 2].map(
      (k) => this.#volume?.tetrahedra[(face & ~3) + (faceNodes[local + k] ?? 0)] ?? 0,
    );
    return { tetrahedron: face >> 2, nodes, onBoundary: (this.#neighbours[face] ?? -1) < 0 };
  }

  dispose(): void {
    for (const mesh of [this.#mesh, this.#front]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.#ramp?.dispose();
  }

  #limit(cut: Cut): number {
    const points = this.#volume?.points ?? new Float64Array();
    const [low, high] = this.#extents.get(cut.axis) ?? extentAlong(points, cut.axis);
    this.#extents.set(cut.axis, [low, high]);
    return low + cut.position * (high - low);
  }

  #rebuild(): void {
    const volume = this.#volume;
    if (!volume) {
      this.#faceCount = 0;
      this.#mesh.geometry.setDrawRange(0, 0);
      return;
    }
    const cut = this.#cut?.enabled ? this.#cut : null;
    let centroids: Float32Array | null = null;
    if (cut) {
      centroids = this.#centroids.get(cut.axis) ?? centroidsAlong(volume, cut.axis);
      this.#centroids.set(cut.axis, centroids);
    }
    this.#faceCount = collectVisibleFaces(
      this.#neighbours,
      centroids,
      cut ? this.#limit(cut) : 0,
      cut?.flipped ?? false,
      this.#faces,
    );
    this.#upload(volume);
  }

  /** Reuses the buffers while they are large enough: dragging the cut allocates nothing. */
  #upload(volume: VolumeMesh): void {
    const needed = 3 * this.#faceCount;
    let position = this.#mesh.geometry.getAttribute("position") as BufferAttribute | undefined;
    let value = this.#mesh.geometry.getAttribute("value") as BufferAttribute | undefined;
    if (!position || !value || position.count < needed) {
      const roomy = Math.ceil(needed * 1.25);
      position = new BufferAttribute(new Float32Array(3 * roomy), 3).setUsage(DynamicDrawUsage);
      value = new BufferAttribute(new Float32Array(roomy), 1).setUsage(DynamicDrawUsage);
      this.#mesh.geometry.dispose();
      this.#mesh.geometry = new BufferGeometry();
      this.#mesh.geometry.setAttribute("position", position).setAttribute("value", value);
    }
    writeCorners(volume, this.#faces, this.#faceCount, this.#origin, position.array as Float32Array);
    this.#writeValues(volume, value.array as Float32Array);
    for (const [attribute, size] of [
      [position, 3],
      [value, 1],
    ] as const) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, size * needed);
      attribute.needsUpdate = true;
    }
    this.#mesh.geometry.setDrawRange(0, needed);
  }

  #writeValues(volume: VolumeMesh, values: Float32Array): void {
    if (this.#shading === "plain") return;
    const quality = qualityOf(volume, this.#shading);
    for (let i = 0; i < this.#faceCount; ++i) {
      const value = quality[(this.#faces[i] ?? 0) >> 2] ?? 0;
      values.fill(placeOnScale(value, this.#shading), 3 * i, 3 * i + 3);
    }
  }

  #showFront(result: MeshResult | null): void {
    const incomplete = result !== null && result.report.status !== "done";
    const hasElements = (result?.volume.tetrahedra.length ?? 0) > 0;
    const triangles = incomplete ? (hasElements ? result.volume.front : result.surface.triangles) : [];
    const points = hasElements ? result?.volume.points : result?.surface.points;
    const corners = new Float32Array(3 * triangles.length);
    for (let i = 0; points && i < triangles.length; ++i) {
      const at = 3 * (triangles[i] ?? 0);
      for (let k = 0; k < 3; ++k) corners[3 * i + k] = (points[at + k] ?? 0) - (this.#origin[k] ?? 0);
    }
    this.#frontMaterial.side = DoubleSide;
    this.#front.geometry.dispose();
    this.#front.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3));
  }
}
