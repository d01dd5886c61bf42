import type { MeshResult } from "tetrafront";
import { BufferAttribute, BufferGeometry, Mesh } from "three";
import { createFacetMaterial } from "../materials/facet-material";
import { setColor } from "../materials/uniforms";
import type { Position } from "../position";
import type { FrontFaces, SceneChanges, SceneState } from "../scene-state";
import type { Layer } from "./layer";

/** The buffer grows by this factor when it is too small. */
const growth = 1.5;

/** The front: that of the current run as it advances, or the rest of it in an incomplete mesh. */
export class FrontLayer implements Layer {
  readonly #material = createFacetMaterial({ opacity: 1, depthWrite: true, edges: true });
  readonly #geometry = new BufferGeometry();
  readonly root = new Mesh(this.#geometry, this.#material);
  #position = new BufferAttribute(new Float32Array(), 3);

  constructor() {
    this.root.frustumCulled = false;
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    if (changes.has("colors")) {
      setColor(this.#material, "color", state.colors.front);
      setColor(this.#material, "edgeColor", state.colors.meshEdge);
    }
    if (changes.has("front", "mesh", "origin"))
      this.#write(state.front ?? remainingFront(state.mesh), state.origin);
    this.root.visible = state.layers.mesh && this.#geometry.drawRange.count > 0;
  }

  dispose(): void {
    this.#geometry.dispose();
    this.#material.dispose();
  }

  #write({ points, triangles }: FrontFaces, origin: Position): void {
    if (3 * triangles.length > this.#position.array.length)
      this.#allocate(Math.ceil(growth * triangles.length));
    const corners = this.#position.array;
    let at = 0;
    for (const node of triangles) {
      for (let k = 0; k < 3; ++k) corners[at++] = (points[3 * node + k] ?? 0) - (origin[k] ?? 0);
    }
    this.#geometry.setDrawRange(0, triangles.length);
    this.#position.clearUpdateRanges();
    this.#position.addUpdateRange(0, at);
    this.#position.needsUpdate = true;
  }

  #allocate(corners: number): void {
    this.#geometry.dispose();
    this.#position = new BufferAttribute(new Float32Array(3 * corners), 3);
    this.#geometry.setAttribute("position", this.#position);
  }
}

/** Returns the front that an incomplete run left; without tetrahedra, that is the boundary. */
function remainingFront(mesh: SceneState["mesh"]): FrontFaces {
  const isIncomplete = mesh?.report.status === "stalled" || mesh?.report.status === "cancelled";
  if (!mesh || !isIncomplete) return { points: new Float64Array(), triangles: new Uint32Array() };
  return frontOf(mesh);
}

function frontOf({ volume, surface }: MeshResult): FrontFaces {
  if (volume.tetrahedra.length === 0) return { points: surface.points, triangles: surface.triangles };
  return { points: volume.points, triangles: volume.front };
}
