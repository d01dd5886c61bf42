/**
 * The engine's code, fetched and compiled once for all workers of this page or thread. The first worker compiles
 * it and returns it; workers that start meanwhile wait for it, later ones get it at once. If the first one fails,
 * the next one in the queue compiles.
 */
import type { CompiledEngine } from "./loader.js";

/** A worker that needs the code. */
export interface EngineLoader {
  /** Called once: with the code, or without it if this worker is to compile it. */
  load(module: CompiledEngine | undefined): void;
}

let compiled: CompiledEngine | undefined;
/** Workers that wait; the first of them compiles. */
const inLine: EngineLoader[] = [];

/** Makes `loader` load the engine, now or when the code is available. */
export function requestEngine(loader: EngineLoader): void {
  if (compiled !== undefined) return loader.load(compiled);
  inLine.push(loader);
  if (inLine.length === 1) loader.load(undefined);
}

/**
 * `loader` has compiled `module`; undefined if it has failed or was terminated. Does nothing if it was not in the
 * queue.
 */
export function settleEngine(loader: EngineLoader, module: CompiledEngine | undefined): void {
  const index = inLine.indexOf(loader);
  if (index < 0) return;
  inLine.splice(index, 1);
  if (module !== undefined) {
    compiled = module;
    for (const other of inLine.splice(0)) other.load(module);
  } else if (index === 0) {
    inLine[0]?.load(undefined);
  }
}
