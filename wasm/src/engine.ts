/** Loads the compiled engine, once per worker. The only file that names the compiled module. */
import createEngine, {
  type Inspection,
  type MainModule,
  type Repair,
  type Run,
  type VolumeInspection,
} from "./engine.mjs";

export type Engine = MainModule;
export type EngineRun = Run;
/** What works in slices and has one result. */
export type EngineTool = Inspection | Repair | VolumeInspection;

let loading: Promise<Engine> | undefined;

/** The engine; the same one at every call. Rejects where WebAssembly or the file is missing. */
export function loadEngine(): Promise<Engine> {
  loading ??= createEngine();
  return loading;
}
