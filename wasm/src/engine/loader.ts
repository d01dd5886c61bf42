/** Loads the compiled engine, once per worker. The only file that names the compiled module. */
import createEngine, {
  type Cover,
  type Inspection,
  type MainModule,
  type BackgroundFromMesh,
  type Preview,
  type Proposal,
  type Refinement,
  type Remesh,
  type Repair,
  type Run,
  type VolumeInspection,
} from "./engine.js";

type ResultOf<Tool extends keyof Engine> = Engine[Tool] extends (...given: never[]) => infer Made
  ? NonNullable<Made> extends { result(): infer Result }
    ? Result
    : never
  : never;
/** Results of the engine, as engine.d.ts states them. */
export type EngineDiagnostics = ReturnType<Run["diagnostics"]>;
export type EngineStatistics = ReturnType<Run["statistics"]>;
export type EngineInspection = ResultOf<"inspectSurface">;
export type EngineRepair = ResultOf<"repairSurface">;
export type EngineRefinement = ResultOf<"refineSurface">;
export type EngineRemesh = ResultOf<"remeshSurface">;
export type EngineVolumeInspection = ResultOf<"inspectMesh">;
export type EnginePreview = ResultOf<"previewModel">;
export type EngineProposal = ResultOf<"propose">;
export type EngineGrid = ResultOf<"cover">;

/** Options of the engine: 0 for a size that is not given, and enumerators by their numbers. */
export type EngineOptions = Readonly<Parameters<Engine["meshModel"]>[2]>;
export type EngineInspectionOptions = Readonly<Parameters<Engine["inspectSurface"]>[2]>;
export type EngineProposalOptions = Readonly<Parameters<Engine["propose"]>[1]>;
export type EngineRepairOptions = Readonly<Parameters<Engine["repairSurface"]>[2]>;
export type EngineRemeshOptions = Readonly<Parameters<Engine["remeshSurface"]>[4]>;

export type Engine = MainModule;
export type EngineRun = Run;
/** A tool of the engine that works in slices and has one result. */
export type EngineTool =
  | Cover
  | Inspection
  | BackgroundFromMesh
  | Preview
  | Proposal
  | Refinement
  | Remesh
  | Repair
  | VolumeInspection;

/** Fetches and compiles the file; the reason of a failure names the file. */
export type CompileEngine = (address: URL) => Promise<CompiledEngine>;

/** An engine and its compiled code, for other workers. */
export interface LoadedEngine {
  readonly engine: Engine;
  readonly module: CompiledEngine;
}

/**
 * Returns an engine from `given` code or, without it, from the file beside this module. Rejects if WebAssembly or
 * the file is missing.
 */
export async function loadEngine(
  given: CompiledEngine | undefined,
  compile: CompileEngine,
): Promise<LoadedEngine> {
  const found = given ?? (await compile(new URL("./engine.wasm", import.meta.url)));
  const module = found as WebAssembly.Module;
  const engine = await new Promise<Engine>((resolve, reject) => {
    // Emscripten's own promise does not report failures in this function.
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

/** A WebAssembly.Module, under a name that also exists without the types of browsers. */
export type CompiledEngine = object;
