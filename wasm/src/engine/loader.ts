/** Loads the compiled engine, once per worker. The only file that names the compiled module. */
import createEngine, {
  type Cover,
  type Inspection,
  type MainModule,
  type BackgroundFromMesh,
  type Preview,
  type Proposal,
  type Refinement,
  type Repair,
  type Run,
  type VolumeInspection,
} from "./engine.js";

type ResultOf<Tool extends keyof Engine> = Engine[Tool] extends (...given: never[]) => infer Made
  ? NonNullable<Made> extends { result(): infer Result }
    ? Result
    : never
  : never;
/** The engine's answers, which cross to the caller as they are. */
export type EngineInspection = ResultOf<"inspectSurface">;
export type EngineRepair = ResultOf<"repairSurface">;
export type EngineRefinement = ResultOf<"refineSurface">;
export type EngineVolumeInspection = ResultOf<"inspectMesh">;

export type { DiagnosticArrays } from "./engine.js";
export type Engine = MainModule;
export type EngineRun = Run;
/** What works in slices and has one result. */
export type EngineTool =
  Cover | Inspection | BackgroundFromMesh | Preview | Proposal | Refinement | Repair | VolumeInspection;

/** Fetches the file and compiles it; rejects with words that name the file and why it is not to be had. */
export type CompileEngine = (address: URL) => Promise<CompiledEngine>;

/** An engine, and its code for those who load another one. */
export interface LoadedEngine {
  readonly engine: Engine;
  readonly module: CompiledEngine;
}

/** The engine, of `given` code or of that beside this module. Rejects where WebAssembly or the file is missing. */
export async function loadEngine(
  given: CompiledEngine | undefined,
  compile: CompileEngine,
): Promise<LoadedEngine> {
  const found = given ?? (await compile(new URL("./engine.wasm", import.meta.url)));
  const module = found as WebAssembly.Module;
  const engine = await new Promise<Engine>((resolve, reject) => {
    // Of what goes wrong in here Emscripten's own promise would never hear.
    const instantiateWasm = (imports: WebAssembly.Imports, receive: ReceiveInstance) => {
      WebAssembly.instantiate(module, imports)
        .then((instance) => receive(instance, module))
        .catch(reject);
      return {};
    };
    createEngine({ instantiateWasm }).then(resolve, reject);
  });
  return { engine, module };
}

type ReceiveInstance = (instance: WebAssembly.Instance, module: WebAssembly.Module) => void;

/** A WebAssembly.Module, by a name that programs without the types of browsers know too. */
export type CompiledEngine = object;
