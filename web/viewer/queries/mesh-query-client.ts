import type { Histogram, QualityMeasure, QualitySpace } from "../../document/mesh-quality";
import { copyForTransfer } from "../../workers/transfer";
import { WorkerClient } from "../../workers/worker-client";
import type { DrawnFaces, QueriedMesh, ViewOptions } from "./mesh-queries";
import type { MeshQueryProtocol } from "./mesh-query-protocol";
import type { SerializedTree } from "../triangle-tree";

const startWorker = (): Worker =>
  new Worker(new URL("./mesh-query-worker.ts", import.meta.url), {
    type: "module",
    name: "tetrafront-mesh-queries",
  });

/**
 * Runs queries over a whole mesh in a worker, so that the page stays responsive. The worker keeps a copy of the
 * mesh queried last. If a query fails, for example out of memory, pending queries reject and the next query starts
 * a new worker.
 */
export class MeshQueryClient {
  readonly #worker = new WorkerClient<MeshQueryProtocol>(startWorker, () => (this.#sentMesh = null));
  /** The mesh that the worker has a copy of. */
  #sentMesh: QueriedMesh | null = null;

  constructor() {
    // Load the worker while the first mesh is being made.
    this.#worker.start();
  }

  /** Returns the triangles to draw. */
  facesOf(mesh: QueriedMesh, options: ViewOptions): Promise<DrawnFaces> {
    return this.#query(mesh, () => this.#worker.call("faces", options));
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

  /** Builds a tree for hit tests over any triangles, x y z of three corners each. Takes over the array. */
  treeOf(corners: Float32Array<ArrayBuffer>): Promise<SerializedTree> {
    return this.#worker.call("tree", corners, [corners.buffer]);
  }

  /** Frees the worker's copy of the mesh. */
  release(): void {
    if (this.#sentMesh) this.#worker.call("setMesh", null).catch(() => undefined);
    this.#sentMesh = null;
  }

  async #query<T>(mesh: QueriedMesh, query: () => Promise<T>): Promise<T> {
    try {
      if (this.#sentMesh !== mesh) this.#send(mesh);
      return await query();
    } catch (error) {
      this.#worker.dispose();
      throw error;
    }
  }

  #send(mesh: QueriedMesh): void {
    const { points, tetrahedra, regions } = mesh.volume;
    const volume = copyForTransfer({ points, tetrahedra, regions });
    const shapes = mesh.metricShapes && copyForTransfer(mesh.metricShapes);
    const copy = { volume: volume.copy, metricShapes: shapes?.copy };
    const buffers = [...volume.buffers, ...(shapes?.buffers ?? [])];
    // If this call fails, the query after it fails too.
    this.#worker.call("setMesh", copy, buffers).catch(() => undefined);
    this.#sentMesh = mesh;
  }
}
