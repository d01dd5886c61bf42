/** Loads the compiled engine, once per worker. The only file that names the compiled module. */
import createEngine, {
  type Inspection,
  type MainModule,
  type Refinement,
  type Repair,
  type Run,
  type VolumeInspection,
} from "./engine.mjs";

export type Engine = MainModule;
export type EngineRun = Run;
/** What works in slices and has one result. */
export type EngineTool = Inspection | Refinement | Repair | VolumeInspection;

let loading: Promise<Engine> | undefined;

/** The engine; the same one at every call. Rejects where WebAssembly or the file is missing. */
export function loadEngine(): Promise<Engine> {
  loading ??= createEngine();
  return loading;
}

/**
 * Why `loadEngine` was rejected with this, and where the code was looked for, as far as that is known: bundlers alone know
 * its address, but a worker remembers what it asked for, in most browsers with the status of the answer.
 */
export function whyNotLoaded(failure: unknown): string {
  const said = String(failure).replace(/\.?( Build with -sASSERTIONS for more info\.)?$/, "");
  const asked = performance.getEntriesByType("resource") as readonly Answered[];
  const { name, responseStatus = 0 } = asked.filter((entry) => entry.name.includes(".wasm")).at(-1) ?? {};
  if (name === undefined) return said;
  return responseStatus >= 400
    ? `${name} is answered with HTTP status ${responseStatus}`
    : `${name}: ${said}`;
}

/** What is used of the timing of a resource; some browsers give no status. */
interface Answered {
  readonly name: string;
  readonly responseStatus?: number;
}
