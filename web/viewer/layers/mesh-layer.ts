import type { MeshResult } from "tetrafront";
import { BufferAttribute, BufferGeometry, FrontSide, Mesh, Sphere, type DataTexture, type Ray } from "three";
import { patchAt } from "../../document/entities";
import type { QualitySpace } from "../../document/mesh-quality";
import type { Cut, Shading } from "../../document/selection";
import type { ShownField } from "../../session/solutions";
import { createMeshMaterial } from "../materials/mesh-material";
import { paletteTexture, rampTexture } from "../materials/textures";
import { setColor, setNumber, setTexture } from "../materials/uniforms";
import type { ViewerColors } from "../colors";
import type { DrawnFaces } from "../queries/visible-faces";
import type { MeshQueryClient } from "../queries/mesh-query-client";
import { PatchFinder } from "../patch-finder";
import type { Position } from "../../document/position";
import { drawsIsosurface, drawsMesh, type SceneChanges, type SceneState } from "../scene-state";
import type { Screen } from "../screen";
import { faceNodes } from "../queries/topology";
import { TriangleTree, type TriangleHit } from "../triangle-tree";
import { addOrigin, type Hit, type HittableLayer, type Target } from "./layer";

/** How far an out-of-date mesh fades towards the background. */
const staleFading = 0.62;

const noFaces = {
  corners: new Float32Array(),
  shares: new Uint8Array(),
  shareUnit: 1,
  values: new Float32Array(),
};

export interface MeshLayerEvents {
  /** Called when the drawn faces or the required ones have changed. */
  readonly onChange: () => void;
  /** Called when the query for the faces has failed. */
  readonly onFailure: (reason: string) => void;
}

/** The result of a run, or a mesh that a run is optimizing. */
type ShownMesh = Pick<MeshResult, "mesh" | "metricShapes">;

/** Which faces to draw. Compared by identity. */
interface FaceRequest {
  readonly mesh: ShownMesh | null;
  readonly origin: Position;
  readonly cut: Cut | null;
  readonly hiddenRegions: ReadonlySet<number>;
  readonly shading: Shading;
  readonly qualitySpace: QualitySpace;
  /** Null if the colours show none. */
  readonly field: ShownField | null;
}

const requestParts = ["mesh", "origin", "cut", "hiddenRegions", "shading", "qualitySpace", "field"] as const;
/** Parts of the scene that a request depends on. */
const sceneParts = [
  "mesh",
  "origin",
  "cut",
  "hiddenRegions",
  "shading",
  "qualitySpace",
  "unoptimized",
  "shownField",
] as const;

/** The faces drawn, and the request that they answer. */
interface DrawnMesh {
  readonly request: FaceRequest;
  readonly faces: DrawnFaces | null;
  readonly tree: TriangleTree | null;
}

/**
 * The tetrahedra of the mesh: its boundary, or the part that a cut leaves. A query in a worker finds the
 * faces to draw. Until it answers, the previous faces stay; of all requests that arrive in the meantime, only
 * the last one is queried.
 */
export class MeshLayer implements HittableLayer {
  readonly #material = createMeshMaterial();
  readonly root = new Mesh(new BufferGeometry(), this.#material);
  readonly #queries: MeshQueryClient;
  readonly #events: MeshLayerEvents;
  /** Colours of quality, and of regions. */
  #ramp: DataTexture | null = null;
  #palette: DataTexture | null = null;
  #request: FaceRequest = {
    mesh: null,
    origin: [0, 0, 0],
    cut: null,
    hiddenRegions: new Set(),
    shading: "radius-ratio",
    qualitySpace: "metric",
    field: null,
  };
  #drawn: DrawnMesh = { request: this.#request, faces: null, tree: null };
  #isQuerying = false;
  #isShown = true;
  /** Returns whether the page has the elements that are drawn. */
  #hasElements = true;
  #patchFinder: PatchFinder | null = null;
  #project: SceneState["project"] | null = null;

  constructor(queries: MeshQueryClient, events: MeshLayerEvents) {
    this.#queries = queries;
    this.#events = events;
    this.root.frustumCulled = false;
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    this.#isShown = drawsMesh(state) && state.front === null && !drawsIsosurface(state);
    this.#project = state.project;
    if (changes.has("colors")) this.#setColors(state.colors);
    setNumber(this.#material, "edges", state.edges ? 1 : 0);
    const isStale = state.isMeshStale && !state.unoptimized;
    setNumber(this.#material, "fading", isStale ? staleFading : 0);
    if (changes.has("mesh", "unoptimized")) this.#patchFinder = null;
    this.#hasElements = state.unoptimized === null;
    if (changes.has(...sceneParts)) this.#require(state);
    // A new mesh is queried right away, so that its picture precedes the queries for its statistics.
    if (changes.has("mesh", "unoptimized", "origin")) this.queryFaces();
    this.#setVisibility();
  }

  /** Queries the faces that are required but not drawn: call it once per frame, however often the cut moves. */
  queryFaces(): void {
    if (!this.isCurrent && !this.#isQuerying) void this.#query();
  }

  /** True if the faces drawn are those required. */
  get isCurrent(): boolean {
    return this.#drawn.request === this.#request;
  }

  /** Number of triangles drawn. */
  get faceCount(): number {
    return this.#drawn.faces?.faces.length ?? 0;
  }

  hit(ray: Ray, screen: Screen): Hit | null {
    const { request, tree } = this.#drawn;
    const isOfMesh = request.mesh === this.#request.mesh && request.origin === this.#request.origin;
    const hit = this.#isShown && isOfMesh ? tree?.firstHit(ray, FrontSide) : null;
    const target = hit && hit.distance <= screen.maxDepth ? this.#targetOf(hit) : null;
    if (!hit || !target) return null;
    return {
      target,
      position: addOrigin(hit.point, request.origin),
      depth: hit.distance,
    };
  }

  dispose(): void {
    this.root.geometry.dispose();
    this.#material.dispose();
    this.#ramp?.dispose();
    this.#palette?.dispose();
  }

  #setColors(colors: ViewerColors): void {
    this.#ramp?.dispose();
    this.#palette?.dispose();
    this.#ramp = rampTexture(colors.ramp);
    this.#palette = paletteTexture(colors.regions);
    this.#setScale();
    setColor(this.#material, "plainColor", colors.meshPlain);
    setColor(this.#material, "edgeColor", colors.meshEdge);
    setColor(this.#material, "fadedColor", colors.faded);
  }

  #require({
    unoptimized,
    mesh: result,
    origin,
    cut,
    hiddenRegions,
    shading,
    qualitySpace,
    shownField,
  }: SceneState): void {
    const mesh: ShownMesh | null = unoptimized ?? result;
    const request = {
      mesh,
      origin,
      cut: cut.enabled ? cut : null,
      hiddenRegions,
      shading,
      qualitySpace: mesh?.metricShapes ? qualitySpace : "space",
      // While another mesh is shown, for example one that is being optimized, the values belong to none of its nodes.
      field: shownField?.tetrahedra === mesh?.mesh.tetrahedra ? shownField : null,
    } as const;
    if (requestParts.every((part) => request[part] === this.#request[part])) return;
    this.#request = request;
    if (mesh === null) {
      this.#queries.release();
      this.#show(request, null);
    }
    this.#move();
    this.#events.onChange();
  }

  /** Queries until an answer contains the faces that are required at that time. */
  async #query(): Promise<void> {
    this.#isQuerying = true;
    let request = this.#request;
    try {
      while (!this.isCurrent) {
        request = this.#request;
        const { mesh, field, ...options } = request;
        if (!mesh) break;
        const faces = await this.#queries.facesOf(mesh, options, field);
        if (mesh === this.#request.mesh) this.#show(request, faces);
      }
    } catch (failure) {
      // The next frame queries the faces that have been required since.
      this.#show(request, null);
      this.#events.onFailure(failure instanceof Error ? failure.message : String(failure));
    } finally {
      this.#isQuerying = false;
    }
  }

  #show(request: FaceRequest, faces: DrawnFaces | null): void {
    const { corners, shares, shareUnit, values } = faces ?? noFaces;
    this.#drawn = { request, faces, tree: faces && new TriangleTree(corners) };
    setNumber(this.#material, "shaded", values.length > 0 ? 1 : 0);
    setNumber(this.#material, "curved", shares.length > 0 ? shareUnit : 0);
    this.#setScale();
    this.root.geometry.dispose();
    this.root.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3));
    // It only decides the order of drawing. The renderer would compute it from all corners.
    this.root.geometry.boundingSphere = new Sphere();
    if (values.length > 0) this.root.geometry.setAttribute("value", new BufferAttribute(values, 1));
    if (shares.length > 0) this.root.geometry.setAttribute("share", new BufferAttribute(shares, 3));
    this.#setVisibility();
    this.#move();
    // Build no tree while a cut moves: the next faces would wait for it.
    if (this.isCurrent) void this.#drawn.tree?.prepare((copy) => this.#queries.treeOf(copy));
    this.#events.onChange();
  }

  /** Sets the colours that represent the drawn values. */
  #setScale(): void {
    const { shading, field } = this.#drawn.request;
    const byRegion = shading === "region" && !field;
    // Each element has one colour.
    setNumber(this.#material, "lines", field?.isPerElement === false ? field.lines : 0);
    setTexture(this.#material, "ramp", byRegion ? this.#palette : this.#ramp);
    setNumber(this.#material, "hues", byRegion ? (this.#palette?.image.width ?? 0) : 0);
  }

  #setVisibility(): void {
    this.root.visible = this.#isShown && this.faceCount > 0;
  }

  /** Keeps the faces drawn at their positions when the origin moves. */
  #move(): void {
    const { origin } = this.#drawn.request;
    const [x, y, z] = this.#request.origin;
    this.root.position.set(origin[0] - x, origin[1] - y, origin[2] - z);
  }

  /**
   * A face of the boundary selects its patch, a face of the cut its tetrahedron. A tetrahedron of a mesh that
   * is being optimized cannot be selected, because another mesh will replace it.
   */
  #targetOf({ triangle }: TriangleHit): Target | null {
    const { faces } = this.#drawn;
    const face = faces?.faces[triangle] ?? 0;
    const patch = faces?.onBoundary[triangle] === 1 ? this.#patchOf(face) : null;
    const entity = patch === null || !this.#project ? undefined : patchAt(this.#project, patch);
    if (entity) return entity;
    return this.#hasElements ? { kind: "element", index: face >> 2 } : null;
  }

  #patchOf(face: number): number | null {
    const { mesh } = this.#drawn.request;
    if (!mesh) return null;
    this.#patchFinder ??= new PatchFinder(mesh.mesh);
    const { tetrahedra } = mesh.mesh;
    const local = 3 * (face & 3);
    return this.#patchFinder.patchOf(
      [0, 1, 2].map((k) => tetrahedra[(face & ~3) + (faceNodes[local + k] ?? 0)] ?? 0),
    );
  }
}
