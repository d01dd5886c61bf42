/**
 * Workers that optimize tiles of a run beside its own worker. They begin when the first tile waits, and each has at most one, so
 * that their memory is bounded. The mesh does not depend on which worker does what. If one of them fails, the run does
 * its tile itself.
 */
import { tileHost } from "#tile-host";
import { DEFAULT_THREADS } from "../base/limits.js";
import type { CompiledModule } from "./instantiated.js";
import type { TiledRun } from "./loader.js";
import type { TileWorker, TileWorkerEvents } from "./tile-host.js";
import type { TileReply } from "./tile-protocol.js";
import { buffersOf } from "./transfer.js";

/** Longest time without a look at whether the run was cancelled, in milliseconds. */
const WAIT_MS = 12;

/** Returns how many threads may optimize tiles of a run; `asked`: the option of the caller; undefined for the default. */
export function usableThreads(asked: number | undefined): number {
  return tileHost.isAvailable ? (asked ?? Math.min(tileHost.cores(), DEFAULT_THREADS)) : 1;
}

interface Helper {
  readonly worker: TileWorker;
  /** The id of the tile that it has; undefined if it is idle. */
  tile: number | undefined;
  /** Whether it has done a tile. */
  isProven: boolean;
}

export class TilePool {
  readonly #run: TiledRun;
  readonly #module: CompiledModule;
  readonly #helpers = new Set<Helper>();
  /** Number of workers that may still be started. */
  #spare: number;
  /** What all workers of the run are given; copied once. */
  #steps: Uint8Array | undefined;
  #wake: () => void = () => undefined;

  /** `threads`: how many work at once, the worker of the run included. `module`: the code of the engine. */
  constructor(run: TiledRun, threads: number, module: CompiledModule) {
    this.#run = run;
    this.#module = module;
    this.#spare = threads - 1;
  }

  /** Lends tiles that wait to idle workers, and starts workers for the others. */
  lend(): void {
    for (const helper of this.#helpers) {
      if (helper.tile === undefined) this.#lendTo(helper);
    }
    while (this.#spare > 0 && this.#run.waitingTiles() > 0) {
      --this.#spare;
      const helper = this.#started();
      if (helper !== undefined) this.#lendTo(helper);
    }
  }

  /** Returns whether the run can only wait for tiles that are lent. */
  isAwaited(): boolean {
    return this.#helpers.size > 0 && this.#run.waitsForTiles();
  }

  /** Resolves when a worker has done a tile or failed, or after some milliseconds. */
  async changed(): Promise<void> {
    await new Promise<void>((resolve) => {
      const timer = setTimeout(resolve, WAIT_MS);
      this.#wake = () => {
        clearTimeout(timer);
        resolve();
      };
    });
  }

  /** Ends all workers. The pool must not be used any more. */
  close(): void {
    this.#spare = 0;
    for (const helper of this.#helpers) helper.worker.terminate();
    this.#helpers.clear();
  }

  #lendTo(helper: Helper): void {
    if (this.#run.waitingTiles() === 0) return;
    const { id, mesh } = this.#run.lendTile();
    if (id === 0) return;
    helper.tile = id;
    helper.worker.post({ kind: "tile", id, mesh }, buffersOf(mesh));
  }

  /** Returns a worker that has just been started; undefined if there can be none. */
  #started(): Helper | undefined {
    const worker = startedWorker({
      onReply: (reply) => this.#receive(helper, reply),
      onCrash: () => this.#remove(helper),
    });
    if (worker === undefined) {
      this.#spare = 0;
      return undefined;
    }
    const helper: Helper = { worker, tile: undefined, isProven: false };
    this.#helpers.add(helper);
    this.#steps ??= this.#run.tileSteps();
    worker.post({ kind: "begin", module: this.#module, steps: this.#steps }, []);
    return helper;
  }

  #receive(helper: Helper, reply: TileReply): void {
    if (!this.#helpers.has(helper)) return;
    if (reply.kind === "failed") return this.#remove(helper);
    helper.tile = undefined;
    // A result that cannot be one means that the worker is not sound.
    if (!this.#run.returnTile(reply.id, reply.mesh)) return this.#remove(helper);
    helper.isProven = true;
    this.lend();
    this.#wake();
  }

  /** Ends a worker that has failed. One that has done a tile is replaced, so that there is no endless series of failures. */
  #remove(helper: Helper): void {
    if (!this.#helpers.delete(helper)) return;
    helper.worker.terminate();
    if (helper.tile !== undefined) this.#run.withdrawTile(helper.tile);
    if (helper.isProven) ++this.#spare;
    this.lend();
    this.#wake();
  }
}

/** Returns a new worker; undefined if the page or the process may not start one, which a run can do without. */
function startedWorker(events: TileWorkerEvents): TileWorker | undefined {
  try {
    return tileHost.start(events);
  } catch {
    return undefined;
  }
}
