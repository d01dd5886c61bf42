/**
 * The code of the engine's modules, each fetched and compiled once for all workers of this page or thread. The first
 * worker that needs a module compiles it and returns it; workers that need it meanwhile wait, later ones get it at
 * once. If the first one fails, the next one in the queue compiles.
 */
import type { CompiledModule } from "./instantiated.js";

/** A worker that needs the code of one module. */
export interface CodeLoader {
  /** Called once per request: with the code, or without it if this worker is to compile it. */
  load(module: CompiledModule | undefined): void;
}

export class SharedCode {
  #compiled: CompiledModule | undefined;
  /** Workers that wait; the first of them compiles. */
  readonly #inLine: CodeLoader[] = [];

  /** Makes `loader` load the module, now or when the code is available. */
  request(loader: CodeLoader): void {
    if (this.#compiled !== undefined) return loader.load(this.#compiled);
    this.#inLine.push(loader);
    if (this.#inLine.length === 1) loader.load(undefined);
  }

  /**
   * `loader` has compiled `module`; undefined if it has failed or was terminated. Does nothing if it was not in the
   * queue.
   */
  settle(loader: CodeLoader, module: CompiledModule | undefined): void {
    const index = this.#inLine.indexOf(loader);
    if (index < 0) return;
    this.#inLine.splice(index, 1);
    if (module !== undefined) {
      this.#compiled = module;
      for (const other of this.#inLine.splice(0)) other.load(module);
    } else if (index === 0) {
      this.#inLine[0]?.load(undefined);
    }
  }
}

/** The code of each module. */
export const sharedCode = {
  engine: new SharedCode(),
  tools: new SharedCode(),
  trace: new SharedCode(),
} as const;
