import type { Histogram, QualityMeasure, QualitySpace } from "../../document/mesh-quality";
import type { Position } from "../../document/position";
import type { Cut } from "../../document/selection";
import { copyForTransfer } from "../../workers/transfer";
import { WorkerClient } from "../../workers/worker-client";
import type { QueriedMesh, ViewOptions } from "./mesh-queries";
import type { MeshQueryProtocol, PictureSize } from "./mesh-query-protocol";
import type { DrawnFaces, FieldValues } from "./visible-faces";
import type { SerializedTree } from "../triangle-boxes";

const startWorker = (): Worker =>
  new Worker(new URL("./mesh-query-worker.ts", import.meta.url), {
    type: "module",
    name: "tetrafront-mesh-queries",
  });

interface SentMesh {
  readonly mesh: QueriedMesh;
  /** Resolves when its copy has been posted. */
  readonly posted: Promise<void>;
}

/**
 * Runs queries over a whole mesh in a worker, so that the page stays responsive. The worker keeps a copy of the
 * mesh queried last. If a query fails, for example out of memory, pending queries reject and the next query starts
 * a new worker.
 */
export class MeshQueryClient {
  readonly #worker = new WorkerClient<MeshQueryProtocol>(startWorker, () => (this.#sent = null));
  /** The mesh that the worker has a copy of, or will have. */
  #sent: SentMesh | null = null;
  /** The values that were sent with it last. */
  #sentField: FieldValues | null = null;
  /** Settles when nothing is copied any more: meshes are sent one after the other. */
  #copying: Promise<void> = Promise.resolve();

  constructor() {
    // Load the worker while the first mesh is being made.
    this.#worker.start();
  }

  /** Returns the triangles to draw. With a field, their colours show its values. */
  facesOf(mesh: QueriedMesh, options: ViewOptions, field: FieldValues | null = null): Promise<DrawnFaces> {
    return this.#query(mesh, () => {
      if (field && this.#sentField !== field) this.#sendField(field);
      return this.#worker.call("faces", { ...options, byField: field !== null });
    });
  }

  /** Returns where values at the nodes have a level: x y z of three corners per triangle, relative to `origin`. */
  isosurface(
    mesh: QueriedMesh,
    field: FieldValues,
    level: number,
    origin: Position,
  ): Promise<Float32Array<ArrayBuffer>> {
    return this.#query(mesh, () => {
      if (this.#sentField !== field) this.#sendField(field);
      return this.#worker.call("isosurface", { level, origin });
    });
  }

  /** Returns the distribution of a quality measure over the elements. */
  histogram(
    mesh: QueriedMesh,
    measure: QualityMeasure,
    space: QualitySpace,
    barCount: number,
  ): Promise<Histogram> {
    return this.#query(mesh, () => this.#worker.call("histogram", { measure, space, barCount }));
  }

  /** Returns the cut that exposes an element to a viewer in a direction. */
  cutTo(mesh: QueriedMesh, element: number, toEye: Position): Promise<Cut> {
    return this.#query(mesh, () => this.#worker.call("cut", { element, toEye }));
  }

  /** Returns a small picture of the middle of a view, which it takes over. */
  pictureOf(view: ImageBitmap, size: PictureSize): Promise<Blob> {
    return this.#worker.call("picture", { view, size }, [view]);
  }

  /** Builds a tree for hit tests over any triangles, x y z of three corners each. Takes over the array. */
  treeOf(corners: Float32Array<ArrayBuffer>): Promise<SerializedTree> {
    return this.#worker.call("tree", corners, [corners.buffer]);
  }

  /** Frees the worker's copy of the mesh. */
  release(): void {
    if (!this.#sent) return;
    this.#sent = null;
    const free = (): void => {
      if (!this.#sent) this.#worker.call("setMesh", null).catch(() => undefined);
    };
    void this.#copying.then(free, free);
  }

  async #query<T>(mesh: QueriedMesh, query: () => Promise<T>): Promise<T> {
    try {
      if (this.#sent?.mesh !== mesh) {
        this.#sentField = null;
        this.#copying = this.#send(mesh, this.#copying);
        this.#sent = { mesh, posted: this.#copying };
      }
      await this.#sent.posted;
      return await query();
    } catch (error) {
      if (this.#sent?.mesh === mesh) this.#sent = null;
      this.#worker.dispose();
      throw error;
    }
  }

  #sendField(field: FieldValues): void {
    this.#sentField = field;
    const { values, isPerElement, range, offsets } = field;
    // If this call fails, the query after it fails too.
    this.#worker.call("setField", { values, isPerElement, range, offsets }).catch(() => undefined);
  }

  /** Copies a mesh in slices and posts it, after the one before. */
  async #send(mesh: QueriedMesh, before: Promise<void>): Promise<void> {
    await before.catch(() => undefined);
    const { points, tetrahedra, tetrahedronRegion, curvedEdges } = mesh.mesh;
    const elements = await copyForTransfer({ points, tetrahedra, tetrahedronRegion });
    const shapes = mesh.metricShapes && (await copyForTransfer(mesh.metricShapes));
    const curved = curvedEdges && (await copyForTransfer(curvedEdges));
    const copy = { mesh: { ...elements.copy, curvedEdges: curved?.copy }, metricShapes: shapes?.copy };
    const buffers = [elements, shapes, curved].flatMap((part) => part?.buffers ?? []);
    // If this call fails, the query after it fails too.
    this.#worker.call("setMesh", copy, buffers).catch(() => undefined);
  }
}
