/** `tetrafront mesh`: reads, meshes, writes, and says what happened. */
import { checkOutput, FileProblem, isSameFile, writeOutput } from "./cli-files.js";
import {
  gridArrays,
  numberIn,
  readGrid,
  readModel,
  refuseOptions,
  type GridInput,
  type Input,
} from "./cli-input.js";
import { asBadInput, ExitCode, say, tell } from "./cli-messages.js";
import { ProgressBar } from "./cli-progress-bar.js";
import { packageDiagnostic } from "./diagnostics.js";
import { extensionOf, extensionsThat } from "./formats/file-formats.js";
import { fileMeshOf } from "./formats/file-mesh.js";
import { writeMesh } from "./formats/mesh-files.js";
import { createMesher, MesherError } from "./mesher.js";
import { checkOptions } from "./options.js";
import { emptyReport, emptyResult } from "./report.js";
import type {
  Diagnostic,
  FrontOrder,
  Mesher,
  MeshOptions,
  MeshReport,
  MeshResult,
  MeshStatus,
  Optimization,
  RunControl,
} from "./types.js";

/** As commander hands them over: numbers are still text. */
export interface MeshCommandOptions {
  readonly output: string;
  readonly size?: string;
  readonly growth?: string;
  readonly gradation?: string;
  readonly background?: string;
  readonly order?: FrontOrder;
  /** False after --no-filters. */
  readonly filters: boolean;
  readonly optimize?: Optimization;
  readonly report?: string;
  readonly keepPartial?: boolean;
  readonly quiet?: boolean;
}

const EXIT_CODES: Readonly<Record<MeshStatus, number>> = {
  done: ExitCode.meshed,
  stalled: ExitCode.notCompleted,
  cancelled: ExitCode.notCompleted,
  "invalid-input": ExitCode.badInput,
};

const STANDARD_OUTPUT = "-";

/** What became of a command. */
interface Outcome {
  readonly report: MeshReport;
  readonly exitCode: number;
  /** The file the mesh is in, if any. */
  readonly written: string | null;
}

/** Runs the command; resolves with the exit code. */
export async function meshFile(input: string, options: MeshCommandOptions): Promise<number> {
  const place = await checkReportPlace(input, options.report).catch((failure: unknown) =>
    failed(failure, input),
  );
  // Without a place for it there will be no report, not even about that.
  if (place !== undefined) return place.exitCode;
  const outcome = await meshAndWrite(input, options).catch((failure: unknown) => failed(failure, input));
  const report = { ...outcome.report, input, output: outcome.written };
  const isOut = options.report === undefined || (await writeReport(options.report, report));
  return isOut ? outcome.exitCode : ExitCode.notCompleted;
}

async function meshAndWrite(input: string, options: MeshCommandOptions): Promise<Outcome> {
  const isQuiet = options.quiet === true;
  const meshOptions = readOptions(options);
  await checkMeshPlace(options.output);
  const model = await readModel(input);
  const grid = options.background === undefined ? undefined : await readGrid(options.background);
  const result = await mesh(model, meshOptions, isQuiet, grid && { file: options.background ?? "", grid });
  const { report } = result;
  tell(input, report.diagnostics, { isQuiet });
  const isWanted = mayWrite(result, options);
  const written = isWanted && (await writeResult(options.output, result, model)) ? options.output : null;
  if (!isQuiet && report.status !== "invalid-input") say(summary(input, report, written, options));
  const isLost = isWanted && written === null;
  return { report, written, exitCode: isLost ? ExitCode.notCompleted : EXIT_CODES[report.status] };
}

/** What to report of a run that threw; the messages are out by then. Our own mistakes pass through. */
function failed(failure: unknown, input: string): Outcome {
  const bad = asBadInput(failure, input);
  if (bad !== undefined) {
    tell(bad.subject, bad.diagnostics, { isQuiet: true });
    return badInput(bad.diagnostics);
  }
  if (
    failure instanceof MesherError &&
    (failure.code === "out-of-memory" || failure.code === "engine-failed")
  ) {
    const diagnostics = [packageDiagnostic(failure.code, failure.message, "")];
    tell(input, diagnostics, { isQuiet: true });
    return { report: emptyReport("stalled", diagnostics), exitCode: ExitCode.notCompleted, written: null };
  }
  throw failure;
}

function badInput(diagnostics: readonly Diagnostic[]): Outcome {
  return { report: emptyReport("invalid-input", diagnostics), exitCode: ExitCode.badInput, written: null };
}

function readOptions(options: MeshCommandOptions): MeshOptions {
  const meshOptions: MeshOptions = {
    size: numberIn(options.size),
    growth: numberIn(options.growth),
    gradation: numberIn(options.gradation),
    order: options.order,
    filters: options.filters,
    optimization: options.optimize,
  };
  const wrong = checkOptions(meshOptions);
  if (options.size !== undefined && options.background !== undefined) {
    const message = "both --size and --background are given";
    wrong.push(packageDiagnostic("invalid-option", message, "Give one of them: a size is uniform."));
  }
  refuseOptions(wrong);
  return meshOptions;
}

async function checkMeshPlace(output: string): Promise<void> {
  const extension = extensionOf(output);
  const known = extensionsThat("writes", "volume");
  if (!known.includes(extension)) {
    throw new FileProblem(
      output,
      extension === ""
        ? "the name has no extension to tell the format"
        : `"${extension}" is not a mesh format`,
      `Give a name that ends in ${known.join(" or ")}.`,
    );
  }
  await checkOutput(output);
}

async function checkReportPlace(input: string, report: string | undefined): Promise<undefined> {
  if (report === undefined || report === STANDARD_OUTPUT) return;
  await checkOutput(report);
  if (await isSameFile(report, input)) {
    throw new FileProblem(report, "the report would replace the input", "Give the report another name.");
  }
}

/** A background grid still to be made of what its file holds. */
interface GivenGrid {
  readonly file: string;
  readonly grid: GridInput;
}

async function mesh(
  model: Input,
  options: MeshOptions,
  isQuiet: boolean,
  given: GivenGrid | undefined,
): Promise<MeshResult> {
  const stop = new AbortController();
  // Once: who asks again while the mesher stops wants to be out at once, and gets the default.
  const onSignal = () => stop.abort();
  process.once("SIGINT", onSignal).once("SIGTERM", onSignal);
  const bar = process.stderr.isTTY && !isQuiet ? new ProgressBar() : undefined;
  const mesher = await createMesher();
  const control: RunControl = { signal: stop.signal, onProgress: (progress) => bar?.update(progress) };
  try {
    const all = given === undefined ? options : await withGrid(mesher, options, given);
    if (stop.signal.aborted) return emptyResult("cancelled");
    return model.kind === "project"
      ? await mesher.meshProject(model.project, all, control)
      : await mesher.fillSurface(model.surface, all, control);
  } finally {
    bar?.stop();
    mesher.dispose();
    process.off("SIGINT", onSignal).off("SIGTERM", onSignal);
  }
}

async function withGrid(mesher: Mesher, options: MeshOptions, given: GivenGrid): Promise<MeshOptions> {
  return { ...options, background: await gridArrays(mesher, given.file, given.grid) };
}

function mayWrite({ report, volume }: MeshResult, { keepPartial }: MeshCommandOptions): boolean {
  return report.status === "done" || (keepPartial === true && volume.tetrahedra.length > 0);
}

async function writeResult(output: string, result: MeshResult, model: Input): Promise<boolean> {
  const files = await writeMesh(fileMeshOf(result, model), output);
  for (const { fileName, bytes } of files) {
    if (!(await tryWrite(fileName, bytes))) return false;
  }
  return true;
}

type CommandReport = MeshReport & { readonly input: string; readonly output: string | null };

async function writeReport(file: string, report: CommandReport): Promise<boolean> {
  const text = `${JSON.stringify(report, null, 2)}\n`;
  if (file !== STANDARD_OUTPUT) return tryWrite(file, text);
  process.stdout.write(text);
  return true;
}

/** Whether it could be written; if not, the user is told. */
async function tryWrite(file: string, content: string | Uint8Array): Promise<boolean> {
  try {
    await writeOutput(file, content);
    return true;
  } catch (failure) {
    if (!(failure instanceof FileProblem)) throw failure;
    say(`error: ${file}: ${failure.message}. ${failure.remedy}`);
    return false;
  }
}

function summary(
  input: string,
  report: MeshReport,
  written: string | null,
  { keepPartial }: MeshCommandOptions,
): string {
  const { status, tetrahedra, points, dihedral, radiusRatio, quality, seconds } = report;
  const { missed, limitedByBoundary: limited } = quality;
  const figures = [
    `${tetrahedra} tetrahedra`,
    `${points} points`,
    `dihedral angles ${dihedral.min.toFixed(1)}° to ${dihedral.max.toFixed(1)}°`,
    `mean radius ratio ${radiusRatio.mean.toFixed(3)}`,
    ...(status === "done" ? [`mean edge ${quality.edges.mean.toFixed(2)} of the wanted`] : []),
    ...(missed > 0 ? [`${missed} beyond 30° to 135°`] : []),
    ...(limited.count > 0 ? [`${limited.count} so because of the boundary`] : []),
    `${seconds.total.toFixed(2)} s`,
  ].join(", ");
  const where = written ?? unwritten();
  return `${input}: ${status}, ${figures} -> ${where}`;

  function unwritten(): string {
    if (status === "done") return "not written";
    if (tetrahedra === 0) return "nothing to write";
    return keepPartial === true ? "not written" : "not written; --keep-partial writes what exists";
  }
}
