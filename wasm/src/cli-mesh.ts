/** `tetrafront mesh`: reads, meshes, writes, and says what happened. */
import { packageDiagnostic } from "./diagnostics.js";
import { checkOutput, FileProblem, isSameFile, readInput, writeOutput } from "./cli-files.js";
import { ProgressBar } from "./cli-progress-bar.js";
import { extensionOf, MESH_WRITERS, SURFACE_READERS } from "./formats/file-formats.js";
import { createMesher, MesherError } from "./mesher.js";
import { checkOptions } from "./options.js";
import { readProject } from "./project.js";
import type { Project } from "./project-schema.js";
import type { ReadProblem } from "./read-result.js";
import { emptyReport, emptyResult } from "./report.js";
import type {
  Diagnostic,
  FrontOrder,
  MeshOptions,
  MeshReport,
  MeshResult,
  MeshStatus,
  Optimization,
  RunControl,
  SurfaceInput,
} from "./types.js";

/** As commander hands them over: numbers are still text. */
export interface MeshCommandOptions {
  readonly output: string;
  readonly size?: string;
  readonly growth?: string;
  readonly gradation?: string;
  readonly order?: FrontOrder;
  readonly optimize?: Optimization;
  readonly report?: string;
  readonly keepPartial?: boolean;
  readonly quiet?: boolean;
}

export const ExitCode = { meshed: 0, notCompleted: 1, badInput: 2 } as const;

const EXIT_CODES: Readonly<Record<MeshStatus, number>> = {
  done: ExitCode.meshed,
  stalled: ExitCode.notCompleted,
  cancelled: ExitCode.notCompleted,
  "invalid-input": ExitCode.badInput,
};

const STANDARD_OUTPUT = "-";
const PROJECT_EXTENSION = ".json";

type Input =
  | { readonly kind: "project"; readonly project: Project }
  | { readonly kind: "surface"; readonly surface: SurfaceInput };

/** Raised where the input is bad; becomes messages, a report, and exit code 2. */
class BadInput extends Error {
  constructor(
    /** What the messages are about: a file or an option. */
    readonly subject: string,
    readonly diagnostics: readonly Diagnostic[],
  ) {
    super(subject);
  }
}

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
  const result = await mesh(model, meshOptions, isQuiet);
  const { report } = result;
  tell(input, report.diagnostics, isQuiet);
  const isWanted = mayWrite(result, options);
  const written = isWanted && (await writeMesh(options.output, result, model)) ? options.output : null;
  if (!isQuiet && report.status !== "invalid-input") say(summary(input, report, written));
  const isLost = isWanted && written === null;
  return { report, written, exitCode: isLost ? ExitCode.notCompleted : EXIT_CODES[report.status] };
}

/** What to report of a run that threw; the messages are out by then. Our own mistakes pass through. */
function failed(failure: unknown, input: string): Outcome {
  if (failure instanceof BadInput) {
    tell(failure.subject, failure.diagnostics, true);
    return badInput(failure.diagnostics);
  }
  if (failure instanceof FileProblem) {
    const diagnostics = [packageDiagnostic("unreadable-input", failure.message, failure.remedy)];
    tell(failure.file, diagnostics, true);
    return badInput(diagnostics);
  }
  if (failure instanceof MesherError && failure.code === "invalid-input") {
    tell(input, failure.diagnostics, true);
    return badInput(failure.diagnostics);
  }
  if (failure instanceof MesherError && failure.code !== "disposed" && failure.code !== "invalid-input") {
    const diagnostics = [packageDiagnostic(failure.code, failure.message, "")];
    tell(input, diagnostics, true);
    return { report: emptyReport("stalled", diagnostics), exitCode: ExitCode.notCompleted, written: null };
  }
  throw failure;
}

function badInput(diagnostics: readonly Diagnostic[]): Outcome {
  return { report: emptyReport("invalid-input", diagnostics), exitCode: ExitCode.badInput, written: null };
}

function readOptions(options: MeshCommandOptions): MeshOptions {
  const meshOptions: MeshOptions = {
    size: numberIn(options.size, "--size"),
    growth: numberIn(options.growth, "--growth"),
    gradation: numberIn(options.gradation, "--gradation"),
    order: options.order,
    optimization: options.optimize,
  };
  const wrong = checkOptions(meshOptions);
  if (wrong.length > 0) throw new BadInput("command line", wrong);
  return meshOptions;
}

function numberIn(text: string | undefined, option: string): number | undefined {
  if (text === undefined) return undefined;
  const value = text.trim() === "" ? NaN : Number(text);
  if (!Number.isNaN(value)) return value;
  throw new BadInput(option, [
    packageDiagnostic("invalid-option", `"${text}" is not a number`, "Give a number, for example 0.1."),
  ]);
}

async function checkMeshPlace(output: string): Promise<void> {
  const extension = extensionOf(output);
  if (!Object.hasOwn(MESH_WRITERS, extension)) {
    throw new FileProblem(
      output,
      extension === ""
        ? "the name has no extension to tell the format"
        : `"${extension}" is not a mesh format`,
      `Give a name that ends in ${Object.keys(MESH_WRITERS).join(" or ")}.`,
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

async function readModel(input: string): Promise<Input> {
  const extension = extensionOf(input);
  const readSurface = Object.hasOwn(SURFACE_READERS, extension) ? SURFACE_READERS[extension] : undefined;
  if (extension !== PROJECT_EXTENSION && readSurface === undefined) {
    const known = [PROJECT_EXTENSION, ...Object.keys(SURFACE_READERS)].join(", ");
    throw new FileProblem(
      input,
      extension === "" ? "the name has no extension to tell the format" : `"${extension}" cannot be read`,
      `Give a file that ends in one of ${known}.`,
    );
  }
  const bytes = await readInput(input);
  if (readSurface !== undefined) {
    const read = readSurface(bytes);
    if (read.success) return { kind: "surface", surface: read.value };
    throw new BadInput(input, read.problems.map(unreadable));
  }
  const read = readProject(new TextDecoder().decode(bytes));
  if (read.success) return { kind: "project", project: read.value };
  throw new BadInput(input, read.problems.map(unreadable));
}

function unreadable({ message, remedy, line }: ReadProblem): Diagnostic {
  const place = line === undefined || message.startsWith("line ") ? "" : `line ${line}: `;
  return packageDiagnostic("unreadable-input", `${place}${message}`, remedy);
}

async function mesh(model: Input, options: MeshOptions, isQuiet: boolean): Promise<MeshResult> {
  const stop = new AbortController();
  // Once: who asks again while the mesher stops wants to be out at once, and gets the default.
  const onSignal = () => stop.abort();
  process.once("SIGINT", onSignal).once("SIGTERM", onSignal);
  const bar = process.stderr.isTTY && !isQuiet ? new ProgressBar() : undefined;
  const mesher = await createMesher();
  const control: RunControl = { signal: stop.signal, onProgress: (progress) => bar?.update(progress) };
  try {
    if (stop.signal.aborted) return emptyResult("cancelled");
    return model.kind === "project"
      ? await mesher.meshProject(model.project, options, control)
      : await mesher.fillSurface(model.surface, options, control);
  } finally {
    bar?.stop();
    mesher.dispose();
    process.off("SIGINT", onSignal).off("SIGTERM", onSignal);
  }
}

function mayWrite({ report, volume }: MeshResult, { keepPartial }: MeshCommandOptions): boolean {
  return report.status === "done" || (keepPartial === true && volume.tetrahedra.length > 0);
}

async function writeMesh(output: string, result: MeshResult, model: Input): Promise<boolean> {
  const write = MESH_WRITERS[extensionOf(output)];
  const bytes = write?.(result, model.kind === "project" ? model.project : undefined);
  return bytes !== undefined && (await tryWrite(output, bytes));
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

/** More lines than this scroll the first, most telling ones away. */
const MAX_LINES = 10;

/** One line per warning and error; `isQuiet` leaves the errors. Information is for the report. */
function tell(subject: string, diagnostics: readonly Diagnostic[], isQuiet: boolean): void {
  const lines = diagnostics
    .filter(({ severity }) => severity === "error" || (severity === "warning" && !isQuiet))
    .map(({ severity, message, remedy }) => `${severity}: ${subject}: ${message}. ${remedy}`.trimEnd());
  for (const line of lines.slice(0, MAX_LINES)) say(line);
  const rest = lines.length - MAX_LINES;
  if (rest > 0) say(`${subject}: ${rest} more; --report FILE tells them all`);
}

function summary(input: string, report: MeshReport, written: string | null): string {
  const { status, tetrahedra, points, dihedral, seconds } = report;
  const figures = [
    `${tetrahedra} tetrahedra`,
    `${points} points`,
    `dihedral angles ${dihedral.min.toFixed(1)}° to ${dihedral.max.toFixed(1)}°`,
    `${seconds.total.toFixed(2)} s`,
  ].join(", ");
  const where =
    written ?? (status === "done" ? "not written" : "not written; --keep-partial writes what exists");
  return `${input}: ${status}, ${figures} -> ${where}`;
}

function say(line: string): void {
  process.stderr.write(`tetrafront: ${line}\n`);
}
