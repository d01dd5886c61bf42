import { copyForTransfer } from "../workers/transfer";
import { WorkerClient, type WorkerPort } from "../workers/worker-client";
import { isSolveFailure, SolveError, type Problem, type ProblemSolution, type SolvedMesh } from "./problem";
import type { SolveProtocol } from "./solve-protocol";

const startWorker = (): Worker =>
  new Worker(new URL("./solve-worker.ts", import.meta.url), { type: "module", name: "tetrafront-solver" });

export interface SolveRequest {
  readonly mesh: SolvedMesh;
  readonly problem: Problem;
  /** As in `solveProblem`. */
  readonly start: Float64Array | null;
}

/** Solves problems in a worker of its own, one after the other. */
export class SolveClient {
  readonly #worker: WorkerClient<SolveProtocol>;

  constructor(start: () => WorkerPort = startWorker) {
    this.#worker = new WorkerClient<SolveProtocol>(start);
  }

  /**
   * Solves a problem. Rejects with a `SolveError` if it has no unique solution, and with the reason of the signal as soon as that
   * is aborted: the worker is then stopped, and the next problem gets another one.
   */
  async solve({ mesh, problem, start }: SolveRequest, signal: AbortSignal): Promise<ProblemSolution> {
    const { points, tetrahedra, triangles, trianglePatch } = mesh;
    const { copy, buffers } = await copyForTransfer({ points, tetrahedra, triangles, trianglePatch });
    const begun = start && (await copyForTransfer({ start }));
    signal.throwIfAborted();
    const stop = (): void => this.#worker.dispose();
    signal.addEventListener("abort", stop);
    try {
      const argument = { mesh: copy, problem, start: begun?.copy.start ?? null };
      return await this.#worker.call("solve", argument, [...buffers, ...(begun?.buffers ?? [])]);
    } catch (error) {
      signal.throwIfAborted();
      // A message between threads keeps only the text of an error.
      const text = error instanceof Error ? error.message : "";
      throw isSolveFailure(text) ? new SolveError(text) : error;
    } finally {
      signal.removeEventListener("abort", stop);
    }
  }

  /** Ends the worker. */
  dispose(): void {
    this.#worker.dispose();
  }
}
