import type { Histogram, QualityMeasure } from "../document/mesh-quality";
import { handedOver, workerFailure } from "../workers/transfer";
import type { DrawnFaces, QueriedMesh, ViewOptions } from "./mesh-queries";
import type { Answers, Query, Reply, Request } from "./mesh-query-protocol";

interface PendingQuery {
  readonly resolve: (answer: Answers[keyof Answers]) => void;
  readonly reject: (failure: Error) => void;
}

/**
 * Runs queries over a whole mesh in a worker, so that the page stays responsive. The worker keeps a copy of the
 * mesh queried last. If it fails, for example out of memory, pending queries reject and the next query starts a
 * new worker.
 */
export class MeshQueryClient {
  #worker: Worker | null = null;
  /** The mesh that the worker has a copy of. */
  #sentMesh: QueriedMesh | null = null;
  #lastId = 0;
  readonly #pending = new Map<number, PendingQuery>();

  constructor() {
    // Load the worker while the first mesh is being made.
    this.#startedWorker();
  }

  /** Returns the triangles to draw. */
  facesOf(mesh: QueriedMesh, options: ViewOptions): Promise<DrawnFaces> {
    return this.#ask(mesh, { kind: "faces", options });
  }

  /** Returns the distribution of a quality measure over the elements. */
  histogram(mesh: QueriedMesh, measure: QualityMeasure, barCount: number): Promise<Histogram> {
    return this.#ask(mesh, { kind: "histogram", measure, barCount });
  }

  /** Frees the worker's copy of the mesh. */
  release(): void {
    if (this.#sentMesh) this.#post({ kind: "mesh", mesh: null });
    this.#sentMesh = null;
  }

  async #ask<Kind extends keyof Answers>(
    mesh: QueriedMesh,
    query: Query & { readonly kind: Kind },
  ): Promise<Answers[Kind]> {
    return new Promise((resolve, reject) => {
      this.#send(mesh);
      const id = ++this.#lastId;
      this.#pending.set(id, { resolve: (answer) => resolve(answer as Answers[Kind]), reject });
      this.#post({ kind: "query", id, query });
    });
  }

  #send(mesh: QueriedMesh): void {
    if (this.#sentMesh === mesh) return;
    const { points, tetrahedra, regions } = mesh;
    const { copy, buffers } = handedOver({ points, tetrahedra, regions });
    this.#post({ kind: "mesh", mesh: copy }, buffers);
    // Only now: copying or posting throws if memory runs out.
    this.#sentMesh = mesh;
  }

  #post(request: Request, transfer: Transferable[] = []): void {
    this.#startedWorker().postMessage(request, transfer);
  }

  #startedWorker(): Worker {
    if (this.#worker) return this.#worker;
    const worker = new Worker(new URL("./mesh-query-worker.ts", import.meta.url), {
      type: "module",
      name: "tetrafront-mesh-queries",
    });
    worker.onmessage = ({ data }: MessageEvent<Reply>) => this.#receive(data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.#fail(workerFailure(event));
    };
    this.#worker = worker;
    return worker;
  }

  #receive(reply: Reply): void {
    const pending = this.#pending.get(reply.id);
    this.#pending.delete(reply.id);
    if (reply.kind === "answer") return pending?.resolve(reply.answer);
    pending?.reject(new Error(reply.message));
    this.#fail(reply.message);
  }

  /** Ends the worker: after one failure it is not used again. */
  #fail(message: string): void {
    this.#worker?.terminate();
    this.#worker = null;
    this.#sentMesh = null;
    const failure = new Error(message);
    for (const { reject } of this.#pending.values()) reject(failure);
    this.#pending.clear();
  }
}
