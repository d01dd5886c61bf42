import type { Histogram, QualityMeasure } from "../document/mesh-quality";
import { handedOver, workerFailure } from "../document/workers";
import type { Answers, Question, Reply, Request } from "./mesh-query-protocol";
import type { DrawnFaces, Look, Surveyed } from "./mesh-queries";

interface Asked {
  readonly resolve: (answer: Answers[keyof Answers]) => void;
  readonly reject: (failure: Error) => void;
}

/**
 * Looks through meshes in a worker, so that the page responds however large they are. The worker holds a copy
 * of one mesh, that of the last question. A question is rejected where the worker fails, for want of memory;
 * the next one then gets a new worker.
 */
export class MeshSurvey {
  #worker: Worker | null = null;
  #held: Surveyed | null = null;
  #lastId = 0;
  readonly #asked = new Map<number, Asked>();

  constructor() {
    // Loaded while the first mesh is being made.
    this.#startedWorker();
  }

  /** The triangles to draw. */
  facesOf(mesh: Surveyed, look: Look): Promise<DrawnFaces> {
    return this.#ask(mesh, { kind: "faces", look });
  }

  /** How the elements are spread over a measure of quality. */
  histogram(mesh: Surveyed, measure: QualityMeasure, barCount: number): Promise<Histogram> {
    return this.#ask(mesh, { kind: "histogram", measure, barCount });
  }

  /** Forgets the mesh of the last question. */
  release(): void {
    if (this.#held) this.#post({ kind: "mesh", mesh: null });
    this.#held = null;
  }

  async #ask<Kind extends keyof Answers>(
    mesh: Surveyed,
    question: Question & { readonly kind: Kind },
  ): Promise<Answers[Kind]> {
    return new Promise((resolve, reject) => {
      this.#show(mesh);
      const id = ++this.#lastId;
      this.#asked.set(id, { resolve: (answer) => resolve(answer as Answers[Kind]), reject });
      this.#post({ kind: "question", id, question });
    });
  }

  #show(mesh: Surveyed): void {
    if (this.#held === mesh) return;
    const { points, tetrahedra, regions } = mesh;
    const { copy, buffers } = handedOver({ points, tetrahedra, regions });
    this.#post({ kind: "mesh", mesh: copy }, buffers);
    // Not before: there may be no memory for the copy.
    this.#held = mesh;
  }

  #post(request: Request, transfer: Transferable[] = []): void {
    this.#startedWorker().postMessage(request, transfer);
  }

  #startedWorker(): Worker {
    if (this.#worker) return this.#worker;
    const worker = new Worker(new URL("./mesh-query-worker.ts", import.meta.url), {
      type: "module",
      name: "tetrafront-survey",
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
    const asked = this.#asked.get(reply.id);
    this.#asked.delete(reply.id);
    if (reply.kind === "answer") return asked?.resolve(reply.answer);
    asked?.reject(new Error(reply.message));
    this.#fail(reply.message);
  }

  /** A worker that has failed once is not asked again. */
  #fail(message: string): void {
    this.#worker?.terminate();
    this.#worker = null;
    this.#held = null;
    const failure = new Error(message);
    for (const { reject } of this.#asked.values()) reject(failure);
    this.#asked.clear();
  }
}
