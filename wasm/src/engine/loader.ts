/**
 * Loads the compiled engine: the module "engine", which previews and fills models, fills surfaces and improves meshes, the module
 * "trace", whose runs record the steps of the front, and the module "tools", for everything else. The only file that names
 * the compiled modules, but for plane-loader.ts.
 */
import createEngine, { type MainModule as Engine, type Run } from "./engine.js";
import { type CompiledModule, type CompileModule, instantiated } from "./instantiated.js";
import type { MainModule as Tools } from "./tools.js";
import type { MainModule as TraceEngine, Run as TracedRun } from "./trace.js";

/** What the functions of a module return that make a tool: an object that works in slices and has one result. */
type ToolOf<Module, Name extends keyof Module> = Module[Name] extends (...given: never[]) => infer Made
  ? Extract<NonNullable<Made>, { fraction(): number; result(): unknown }>
  : never;
type ToolsOf<Module> = { [Name in keyof Module]: ToolOf<Module, Name> }[keyof Module];
type ResultOf<Name extends keyof Tools> = ReturnType<ToolOf<Tools, Name>["result"]>;
type EngineResultOf<Name extends keyof Engine> = ReturnType<ToolOf<Engine, Name>["result"]>;
/** Results of the engine, as the types of its modules state them. */
export type EngineDiagnostics = ReturnType<Run["diagnostics"]>;
export type EngineStatistics = ReturnType<Run["statistics"]>;
export type EngineInspection = ResultOf<"inspectSurface">;
export type EngineRepair = ResultOf<"repairSurface">;
export type EngineRefinement = ResultOf<"refineSurface">;
export type EnginePatchSplit = ResultOf<"splitPatches">;
export type EngineRemesh = ResultOf<"remeshSurface">;
export type EngineVolumeInspection = ResultOf<"inspectMesh">;
export type EngineImprovement = ResultOf<"improveMesh">;
export type EngineImproveOptions = Readonly<Parameters<Tools["improveMesh"]>[4]>;
export type EnginePreview = EngineResultOf<"previewModel">;
export type EngineLocation = ResultOf<"locateRegions">;

/** Options of the engine: 0 for a size that is not given, and enumerators by their numbers. */
export type EngineOptions = Readonly<Parameters<Engine["meshModel"]>[2]>;
export type EngineInspectionOptions = Readonly<Parameters<Tools["inspectSurface"]>[2]>;
export type EngineProposalOptions = Readonly<Parameters<Tools["propose"]>[1]>;
export type EngineRepairOptions = Readonly<Parameters<Tools["repairSurface"]>[2]>;
export type EngineSolutionOptions = Readonly<Parameters<Tools["sizeFromSolution"]>[2]>;
export type EngineRemeshOptions = Readonly<Parameters<Tools["remeshSurface"]>[4]>;

export type { Engine, Tools, TraceEngine };
/** A run that lends its tiles: all but those that are recorded. */
export type TiledRun = Pick<
  Run,
  "waitingTiles" | "waitsForTiles" | "tileSteps" | "lendTile" | "returnTile" | "withdrawTile"
>;
/** A run; those of the module "trace" record the steps of the front. */
export type EngineRun = Omit<Run, keyof TiledRun> &
  Partial<TiledRun> &
  Partial<Pick<TracedRun, "takeTrace" | "frontFingerprint" | "recordedSteps" | "experiment">>;

/** Returns whether a run lends its tiles. */
export const isTiled = (run: EngineRun): run is EngineRun & TiledRun => run.lendTile !== undefined;
/** A tool of the engine. */
export type EngineTool = ToolsOf<Tools> | ToolsOf<Engine>;

/** An instance of a module and its compiled code, for other workers. */
export interface LoadedModule<Instance> {
  readonly instance: Instance;
  readonly module: CompiledModule;
}

/**
 * Returns an instance of a module from `given` code or, without it, from the file beside this script. Rejects if
 * WebAssembly or a file is missing.
 */
export type LoadModule<Instance> = (
  given: CompiledModule | undefined,
  compile: CompileModule,
) => Promise<LoadedModule<Instance>>;

export const loadEngine: LoadModule<Engine> = async (given, compile) => {
  const module = given ?? (await compile(new URL("./engine.wasm", import.meta.url)));
  return { instance: await instantiated(createEngine, module), module };
};

export const loadTools: LoadModule<Tools> = async (given, compile) => {
  const [{ default: createTools }, module] = await Promise.all([
    import("./tools.js"),
    given === undefined ? compile(new URL("./tools.wasm", import.meta.url)) : Promise.resolve(given),
  ]);
  return { instance: await instantiated(createTools, module), module };
};

export const loadTraceEngine: LoadModule<TraceEngine> = async (given, compile) => {
  const [{ default: createTrace }, module] = await Promise.all([
    import("./trace.js"),
    given === undefined ? compile(new URL("./trace.wasm", import.meta.url)) : Promise.resolve(given),
  ]);
  return { instance: await instantiated(createTrace, module), module };
};
