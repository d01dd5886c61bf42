import type { MeshResult } from "tetrafront";
import { BufferAttribute, BufferGeometry, Mesh, Sphere } from "three";
import { createFacetMaterial } from "../materials/facet-material";
import { setColor } from "../materials/uniforms";
import type { Position } from "../../document/position";
import type { SceneChanges } from "../scene-state";
import type { Layer } from "./layer";

/** The buffer grows by this factor when it is too small. */
const growth = 1.5;
/** How strongly the front of an incomplete mesh shows through the elements that enclose it. */
const throughOpacity = 0.4;

/** The front of the current run as it advances, or the front that an incomplete mesh ends at, also behind its elements. */
export class FrontLayer implements Layer {
  readonly #material = createFacetMaterial({ opacity: 1, depthWrite: true, edges: true });
  readonly #geometry = new BufferGeometry();
  readonly #through = createFacetMaterial({ opacity: throughOpacity, depthTest: false, edges: true });
  readonly #behind = new Mesh(this.#geometry, this.#through);
  readonly root = new Mesh(this.#geometry, this.#material);
  #position = new BufferAttribute(new Float32Array(), 3);

  constructor() {
    for (const mesh of [this.root, this.#behind]) mesh.frustumCulled = false;
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
    if (changes.has("front", "mesh", "unoptimized", "isMeshOfOthers", "origin")) {
      const isMeshHidden = state.unoptimized !== null || state.isMeshOfOthers;
      this.#write(state.front ?? remainingFront(isMeshHidden ? null : state.mesh), state.origin);
    }
    // While a run advances its front, no elements enclose it.
    this.#behind.visible = state.front === null;
    this.root.visible = state.layers.mesh && this.#geometry.drawRange.count > 0;
  }

  dispose(): void {
    this.#geometry.dispose();
    this.#material.dispose();
    this.#through.dispose();
  }

  /** @param corners x y z of three corners per face, in model coordinates. */
  #write(corners: Float64Array, origin: Position): void {
    if (corners.length > this.#position.array.length)
      this.#allocate(Math.ceil((growth * corners.length) / 3));
    const local = this.#position.array;
    const [x, y, z] = origin;
    for (let i = 0; i < corners.length; i += 3) {
      local[i] = (corners[i] ?? 0) - x;
      local[i + 1] = (corners[i + 1] ?? 0) - y;
      local[i + 2] = (corners[i + 2] ?? 0) - z;
    }
    this.#geometry.setDrawRange(0, corners.length / 3);
    this.#position.clearUpdateRanges();
    this.#position.addUpdateRange(0, corners.length);
    this.#position.needsUpdate = true;
  }

  #allocate(corners: number): void {
    this.#geometry.dispose();
    this.#position = new BufferAttribute(new Float32Array(3 * corners), 3);
    this.#geometry.setAttribute("position", this.#position);
    // Nothing is culled; without a sphere, the renderer would compute one from all corners.
    this.#geometry.boundingSphere = new Sphere();
  }
}

/**
 * Returns the corners of the front at which an incomplete mesh ends; without tetrahedra, those of the
 * boundary.
 */
function remainingFront(result: MeshResult | null): Float64Array {
  const isIncomplete = result?.report.status === "stalled" || result?.report.status === "cancelled";
  if (!result || !isIncomplete) return new Float64Array();
  const { mesh, front } = result;
  return cornersOf(mesh.points, mesh.tetrahedra.length === 0 ? mesh.triangles : front);
}

function cornersOf(points: Float64Array, triangles: Uint32Array): Float64Array {
  const corners = new Float64Array(3 * triangles.length);
  triangles.forEach((node, i) => corners.set(points.subarray(3 * node, 3 * node + 3), 3 * i));
  return corners;
}
