/**
 * The engine's code, fetched and compiled once for all workers of this page or thread: the first worker
 * compiles it and hands it back, those that come meanwhile wait for that, all later ones are given it. What
 * failed is not kept: the next in line tries for itself.
 */
import type { CompiledEngine } from "./loader.js";

/** A worker that needs the code. */
export interface EngineLoader {
  /** Called once: with the code, or without where this worker is to compile it. */
  load(module: CompiledEngine | undefined): void;
}

let compiled: CompiledEngine | undefined;
/** The first of them compiles. */
const inLine: EngineLoader[] = [];

/** Has `loader` load the engine, now or as soon as the code is there. */
export function requestEngine(loader: EngineLoader): void {
  if (compiled !== undefined) return loader.load(compiled);
  inLine.push(loader);
  if (inLine.length === 1) loader.load(undefined);
}

/**
 * `loader` has compiled `module`, or, where that is undefined, has failed or is no more. Nothing happens where it
 * did not stand in line.
 */
export function settleEngine(loader: EngineLoader, module: CompiledEngine | undefined): void {
  const place = inLine.indexOf(loader);
  if (place < 0) return;
  inLine.splice(place, 1);
  if (module !== undefined) {
    compiled = module;
    for (const other of inLine.splice(0)) other.load(module);
  } else if (place === 0) {
    inLine[0]?.load(undefined);
  }
}
