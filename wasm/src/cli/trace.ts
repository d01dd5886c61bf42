/** `tetrafront trace`: records the steps of the front as a file, or describes such a file. */
import path from "node:path";
import * as v from "valibot";
import { recordedTrace } from "../api/trace-recording.js";
import { plural } from "../base/plural.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import {
  experimentSchema,
  type FrontExperiment,
  type FrontSearch,
  MAX_TOLERANCE,
} from "../trace/experiment.js";
import { readTrace } from "../trace/read-trace.js";
import { checkOutput, readInput, STANDARD_STREAM, writeOutput, writeToStandardOutput } from "./files.js";
import { EXIT_CODES, type MeshCommandOptions, meshInput } from "./mesh.js";
import { ExitCode, InvalidInput, print, reportFailure } from "./messages.js";
import { refuseOptions } from "./input.js";
import { numberIn } from "./numbers.js";
import { checkNoOverwrite, inputFiles } from "./paths.js";
import { gridFiles } from "./sizes.js";

/** Options as commander passes them. */
export interface TraceCommandOptions extends Omit<MeshCommandOptions, "output" | "report" | "keepPartial"> {
  readonly output?: string;
  readonly summary?: boolean;
  /** False with `--no-relaxation`. */
  readonly relaxation?: boolean;
  readonly frontTolerance?: string;
  readonly search?: FrontSearch;
}

/** Extension of trace files. */
const EXTENSION = ".tft";

/** Runs the command; resolves with the exit code. */
export async function traceFile(input: string, options: TraceCommandOptions): Promise<number> {
  try {
    const { output, summary = false } = options;
    if (isTrace(input, options) || (summary && output === undefined)) return await summarize(input, options);
    if (output === undefined) throw missingOutput();
    return await record(input, { ...options, output });
  } catch (failure) {
    return reportFailure(failure, input);
  }
}

function isTrace(input: string, { from }: TraceCommandOptions): boolean {
  return (from ?? path.extname(input)).toLowerCase().endsWith(EXTENSION.slice(1));
}

function missingOutput(): InvalidInput {
  const message = "there is no output file for the trace";
  return new InvalidInput("command line", [
    invalidOption("--output", message, "Name one with -o, for example -o run.tft."),
  ]);
}

async function record(
  input: string,
  options: TraceCommandOptions & { readonly output: string },
): Promise<number> {
  const { output, quiet = false, summary = false } = options;
  const checkPaths = async (): Promise<void> => {
    await checkOutput(output);
    const inputs = [...inputFiles(input, options.from), ...gridFiles(options)];
    await checkNoOverwrite(inputs, [{ words: "the trace", file: output }]);
  };
  const experiment = experimentOf(options);
  const events: Uint8Array[] = [];
  // The front is what most readers want to see; --optimize also records the sweeps of the optimizer.
  const made = await meshInput(input, { optimize: "none", ...options }, checkPaths, {
    onTrace: (piece) => void events.push(piece),
    experiment,
  });
  const { result, model } = made;
  const name = model.kind === "project" ? model.project.name : path.parse(input).name;
  const order = options.order ?? (model.kind === "project" ? model.project.meshing?.order : undefined);
  const trace = recordedTrace(result, events, { name, order, experiment });
  const exitCode = EXIT_CODES[result.report.status];
  if (trace === undefined) return exitCode;
  await writeOutput(output, trace);
  if (summary) await printSummary(trace, output);
  else if (!quiet) {
    const steps = plural(result.recording?.steps ?? 0, "step");
    const size = `${(trace.length / 1e6).toFixed(1)} MB`;
    print(
      `${input}: ${result.report.status}, ${steps}, ${size}${output === STANDARD_STREAM ? "" : ` -> ${output}`}`,
    );
  }
  return exitCode;
}

/** Returns the changed rules of the front; undefined if none is changed. */
function experimentOf({
  relaxation,
  frontTolerance,
  search,
}: TraceCommandOptions): FrontExperiment | undefined {
  const tolerance = numberIn(frontTolerance);
  // Without --no-relaxation, it is true.
  if (relaxation !== false && tolerance === undefined && search === undefined) return undefined;
  const experiment = { ...(relaxation === false && { relaxation }), tolerance, search };
  if (!v.is(experimentSchema, experiment)) {
    const message = `"${frontTolerance ?? ""}" is not a factor from 0 to ${MAX_TOLERANCE}`;
    refuseOptions([
      invalidOption(
        "--front-tolerance",
        message,
        "Use 1 for the usual rules, and 0 for exact crossings only.",
      ),
    ]);
  }
  return experiment;
}

async function summarize(input: string, { output, summary = false }: TraceCommandOptions): Promise<number> {
  if (output !== undefined) {
    const message = "the input is a trace, which is not recorded again";
    refuseOptions([invalidOption("--output", message, "Omit --output, or use a model as the input.")]);
  }
  if (!summary) {
    const message = "the input is a trace";
    refuseOptions([invalidOption("--summary", message, "Add --summary to describe it.")]);
  }
  await printSummary(await readInput(input), input);
  return ExitCode.meshed;
}

async function printSummary(bytes: Uint8Array, file: string): Promise<void> {
  const read = readTrace(bytes);
  if (!read.success) {
    throw new InvalidInput(
      file,
      read.errors.map(({ message, remedy }) => packageDiagnostic("unreadable-input", message, remedy)),
    );
  }
  await writeToStandardOutput(`${JSON.stringify(read.value.summary(), undefined, 2)}\n`);
}
