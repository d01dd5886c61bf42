import type { MeshResult, VolumeMesh } from "tetrafront";
import { BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, type DataTexture } from "three";
import type { Cut, Shading } from "../../document/selection";
import type { ViewerColors } from "../colors";
import {
  createFacetMaterial,
  createMeshMaterial,
  paletteTexture,
  rampTexture,
  setColor,
  setNumber,
  setTexture,
} from "../materials";
import type { MeshQueryClient } from "../mesh-query-client";
import type { DrawnFaces } from "../mesh-queries";
import { faceNodes } from "../topology";
import type { Position, SceneLayer } from "./layer";

/** How far an out-of-date mesh fades towards the background. */
const staleFading = 0.62;

export interface MeshLayerEvents {
  /** Other faces are drawn now, or others are wanted than are drawn. */
  readonly onChange: () => void;
  /** The faces could not be found. */
  readonly onFailure: (reason: string) => void;
}

/** What is to be drawn. Equal by identity. */
interface Wanted {
  readonly volume: VolumeMesh | null;
  readonly origin: Position;
  readonly cut: Cut | null;
  readonly hiddenRegions: ReadonlySet<number>;
  readonly shading: Shading;
}

/** What is drawn: of the mesh and in the way that were wanted when it was asked for. */
interface Drawn {
  readonly wanted: Wanted;
  readonly faces: DrawnFaces | null;
}

/**
 * The tetrahedra: the boundary, or what a cut leaves of it, and the front of an incomplete mesh. Which faces
 * these are, a queries finds; until it answers those found last are drawn, and of all that is wanted meanwhile
 * only the last is asked for.
 */
export class MeshLayer implements SceneLayer {
  readonly root = new Group();
  readonly #queries: MeshQueryClient;
  readonly #events: MeshLayerEvents;
  readonly #material = createMeshMaterial();
  readonly #frontMaterial = createFacetMaterial({ opacity: 1, depthWrite: true });
  readonly #mesh = new Mesh(new BufferGeometry(), this.#material);
  readonly #front = new Mesh(new BufferGeometry(), this.#frontMaterial);
  /** The colours of quality, and those of regions. */
  #ramp: DataTexture | null = null;
  #palette: DataTexture | null = null;
  #wanted: Wanted = {
    volume: null,
    origin: [0, 0, 0],
    cut: null,
    hiddenRegions: new Set(),
    shading: "radius-ratio",
  };
  #drawn: Drawn = { wanted: this.#wanted, faces: null };
  #asking = false;

  constructor(queries: MeshQueryClient, events: MeshLayerEvents) {
    this.#queries = queries;
    this.#events = events;
    this.root.add(this.#mesh, this.#front);
    for (const mesh of [this.#mesh, this.#front]) mesh.frustumCulled = false;
  }

  setColors(colors: ViewerColors): void {
    this.#ramp?.dispose();
    this.#palette?.dispose();
    this.#ramp = rampTexture(colors.ramp);
    this.#palette = paletteTexture(colors.regions);
    this.#setScale();
    setColor(this.#material, "plainColor", colors.meshPlain);
    setColor(this.#material, "edgeColor", colors.meshEdge);
    setColor(this.#material, "fadedColor", colors.faded);
    setColor(this.#frontMaterial, "color", colors.front);
  }

  /** Shows another mesh, or none. Asked for at once: figures of the mesh come after its picture. */
  setMesh(result: MeshResult | null, origin: Position): void {
    this.#want({ volume: result?.volume ?? null, origin });
    this.#showFront(result, origin);
    this.refresh();
  }

  setCut(cut: Cut): void {
    const wanted = cut.enabled ? cut : null;
    if (wanted !== this.#wanted.cut) this.#want({ cut: wanted });
  }

  setHiddenRegions(hiddenRegions: ReadonlySet<number>): void {
    if (hiddenRegions !== this.#wanted.hiddenRegions) this.#want({ hiddenRegions });
  }

  /** Asks for the faces that are wanted: once per frame, however often the cut has moved. */
  refresh(): void {
    if (!this.isCurrent && !this.#asking) void this.#update();
  }

  /** Is what is drawn what is wanted? */
  get isCurrent(): boolean {
    return this.#drawn.wanted === this.#wanted;
  }

  setShading(shading: Shading, edges: boolean): void {
    setNumber(this.#material, "edges", edges ? 1 : 0);
    if (shading !== this.#wanted.shading) this.#want({ shading });
  }

  setStale(stale: boolean): void {
    setNumber(this.#material, "fading", stale ? staleFading : 0);
  }

  /** Number of tetrahedra in the mesh, and of faces drawn. */
  get counts(): { readonly tetrahedra: number; readonly drawnFaces: number } {
    return {
      tetrahedra: (this.#wanted.volume?.tetrahedra.length ?? 0) / 4,
      drawnFaces: this.#drawn.faces?.faces.length ?? 0,
    };
  }

  /** The triangles drawn; null without any, and while they are of another mesh than the one wanted. */
  get geometry(): BufferGeometry | null {
    const { wanted, faces } = this.#drawn;
    const isOfMesh = wanted.volume === this.#wanted.volume && wanted.origin === this.#wanted.origin;
    return isOfMesh && faces && faces.faces.length > 0 ? this.#mesh.geometry : null;
  }

  /** The tetrahedron, its face and whether its region ends there, of a drawn triangle. */
  faceAt(triangle: number): { tetrahedron: number; nodes: number[]; onBoundary: boolean } | null {
    const { wanted, faces } = this.#drawn;
    const face = faces?.faces[triangle];
    if (face === undefined) return null;
    const local = 3 * (face & 3);
    const nodes = [0, 1, 2].map(
      (k) => wanted.volume?.tetrahedra[(face & ~3) + (faceNodes[local + k] ?? 0)] ?? 0,
    );
    return { tetrahedron: face >> 2, nodes, onBoundary: faces?.onBoundary[triangle] === 1 };
  }

  dispose(): void {
    for (const mesh of [this.#mesh, this.#front]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.#ramp?.dispose();
    this.#palette?.dispose();
  }

  #want(change: Partial<Wanted>): void {
    this.#wanted = { ...this.#wanted, ...change };
    if (this.#wanted.volume === null) {
      this.#queries.release();
      this.#show({ wanted: this.#wanted, faces: null });
    }
    this.#place();
    this.#events.onChange();
  }

  /** Asks until the last answer is what is wanted by then. */
  async #update(): Promise<void> {
    this.#asking = true;
    let wanted = this.#wanted;
    try {
      while (!this.isCurrent) {
        wanted = this.#wanted;
        const { volume, ...look } = wanted;
        if (!volume) break;
        const faces = await this.#queries.facesOf(volume, look);
        if (volume === this.#wanted.volume) this.#show({ wanted, faces });
      }
    } catch (failure) {
      // What has been wanted since is asked for next.
      this.#show({ wanted, faces: null });
      this.#events.onFailure(failure instanceof Error ? failure.message : String(failure));
    } finally {
      this.#asking = false;
    }
  }

  #show(drawn: Drawn): void {
    this.#drawn = drawn;
    const { corners, values } = drawn.faces ?? { corners: new Float32Array(), values: new Float32Array() };
    setNumber(this.#material, "shaded", values.length > 0 ? 1 : 0);
    this.#setScale();
    this.#mesh.geometry.dispose();
    this.#mesh.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3));
    if (values.length > 0) this.#mesh.geometry.setAttribute("value", new BufferAttribute(values, 1));
    this.#mesh.visible = corners.length > 0;
    this.#place();
    this.#events.onChange();
  }

  /** The colours that the values of what is drawn stand for. */
  #setScale(): void {
    const byRegion = this.#drawn.wanted.shading === "region";
    setTexture(this.#material, "ramp", byRegion ? this.#palette : this.#ramp);
    setNumber(this.#material, "hues", byRegion ? (this.#palette?.image.width ?? 0) : 0);
  }

  /** What is drawn stays where it is when the origin moves. */
  #place(): void {
    const { origin } = this.#drawn.wanted;
    const [x, y, z] = this.#wanted.origin;
    this.#mesh.position.set(origin[0] - x, origin[1] - y, origin[2] - z);
  }

  #showFront(result: MeshResult | null, origin: Position): void {
    const status = result?.report.status;
    const incomplete = status === "stalled" || status === "cancelled";
    const hasElements = (result?.volume.tetrahedra.length ?? 0) > 0;
    const left = hasElements ? result?.volume.front : result?.surface.triangles;
    const triangles = (incomplete ? left : null) ?? [];
    const points = hasElements ? result?.volume.points : result?.surface.points;
    const corners = new Float32Array(3 * triangles.length);
    for (let i = 0; points && i < triangles.length; ++i) {
      const at = 3 * (triangles[i] ?? 0);
      for (let k = 0; k < 3; ++k) corners[3 * i + k] = (points[at + k] ?? 0) - (origin[k] ?? 0);
    }
    this.#frontMaterial.side = DoubleSide;
    this.#front.geometry.dispose();
    this.#front.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(corners, 3));
  }
}
