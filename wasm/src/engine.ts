/** Loads the compiled engine, once per worker. The only file that names the compiled module. */
import createEngine, { type Inspection, type MainModule, type Run } from "./engine.mjs";

export type Engine = MainModule;
export type EngineRun = Run;
export type EngineInspector = Inspection;

let loading: Promise<Engine> | undefined;

/** The engine; the same one at every call. Rejects where WebAssembly or the file is missing. */
export function loadEngine(): Promise<Engine> {
  loading ??= createEngine();
  return loading;
}
