/**
 * The functions of the compiled modules that answer a question in slices. Their arguments and answers are those of the
 * bindings: the messages of a question, the work in the worker and the call of the client follow from this table. A further
 * question needs its binding in C++, a line here, and a public method.
 */
import type { Engine, EngineTool, Tools } from "./loader.js";

/** Per function: the module that has it. Of some, the second argument is an array of triangles. */
export const CALLS = {
  previewModel: { module: "engine" },
  cover: { module: "tools" },
  propose: { module: "tools" },
  sampleSizes: { module: "tools" },
  sampleCurvature: { module: "tools" },
  backgroundFromMesh: { module: "tools" },
  inspectSurface: { module: "tools", hasTriangles: true },
  locateRegions: { module: "tools", hasTriangles: true },
  proposeSurfaceSizes: { module: "tools", hasTriangles: true },
  repairSurface: { module: "tools", hasTriangles: true },
  refineSurface: { module: "tools", hasTriangles: true },
  splitPatches: { module: "tools", hasTriangles: true },
  remeshSurface: { module: "tools", hasTriangles: true },
  placeNodes: { module: "tools", hasTriangles: true },
  inspectMesh: { module: "tools" },
  curveEdges: { module: "tools" },
  sizeFromSolution: { module: "tools" },
  frontSizesOf: { module: "tools" },
  transferSolution: { module: "tools" },
  improveMesh: { module: "tools" },
  adaptMesh: { module: "tools" },
  addLayers: { module: "tools" },
  checkRun: { module: "engine" },
} as const;

interface Modules {
  readonly engine: Engine;
  readonly tools: Tools;
}

export type CallName = keyof typeof CALLS;
type ModuleOf<Name extends CallName> = Modules[(typeof CALLS)[Name]["module"]];
type FunctionOf<Name extends CallName> = Extract<
  ModuleOf<Name>[Name & keyof ModuleOf<Name>],
  (...given: never[]) => EngineTool | null
>;

export type ArgumentsOf<Name extends CallName> = Readonly<Parameters<FunctionOf<Name>>>;
export type AnswerOf<Name extends CallName> =
  NonNullable<ReturnType<FunctionOf<Name>>> extends { result(): infer Answer } ? Answer : never;

/** Begins the work on a question in the module of its call; null if there is no memory for it. */
export function toolFor(
  module: Engine | Tools,
  name: CallName,
  given: readonly unknown[],
): EngineTool | null {
  // The client has checked name and arguments by the table, and the worker takes the module from it.
  const functions = module as unknown as Readonly<
    Record<CallName, (...all: readonly unknown[]) => EngineTool | null>
  >;
  return functions[name](...given);
}

/** Returns the number of triangles of the surface that a question is about; 0 if it has none. */
export function trianglesIn(name: CallName, given: readonly unknown[]): number {
  const [, triangles] = given;
  const isOfSurface = "hasTriangles" in CALLS[name] && triangles instanceof Uint32Array;
  return isOfSurface ? triangles.length / 3 : 0;
}
