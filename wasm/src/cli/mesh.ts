/** `tetrafront mesh`: reads, meshes and writes; prints a summary. */
import { fileMeshOf } from "../api/generated-mesh.js";
import { writeMesh } from "../api/mesh-files.js";
import type { Mesher } from "../api/mesher-interface.js";
import { createMesher } from "../api/mesher.js";
import type { MeshOptions, RefineOptions, RepairOptions } from "../api/option-types.js";
import { checkOptions } from "../api/options.js";
import { repairedSurface } from "../api/repaired-surface.js";
import { emptyReport, emptyResult } from "../api/report.js";
import { plural } from "../base/plural.js";
import type { RunControl } from "../engine/control.js";
import type { Diagnostic, DiagnosticOf } from "../diagnostics/diagnostic.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import type { FrontOrder, Optimization } from "../generated/constants.js";
import type { RepairChange } from "../mesh/inspection.js";
import type { MeshReport, MeshResult, MeshStatus } from "../mesh/report.js";
import { checkBackground } from "../project/background-arrays.js";
import type { ProjectSource } from "../project/schema.js";
import { writableName, writeAll } from "./convert.js";
import { checkOutput, FileError, refuseFolder, writeOutput } from "./files.js";
import { withMesher } from "./grids.js";
import {
  gridArrays,
  type GridInput,
  type Input,
  numberIn,
  readGrid,
  readModel,
  refuseOptions,
} from "./input.js";
import {
  asInvalidInput,
  asEngineFailure,
  InvalidInput,
  ExitCode,
  print,
  printDiagnostics,
} from "./messages.js";
import { checkNoOverwrite, checkWritable, inputFiles, outputFiles } from "./paths.js";
import { ProgressBar } from "./progress-bar.js";
import { printChanges, refuseRepair, type RepairCommandOptions, repaired, repairOptions } from "./repair.js";
import { readingLines, unmeshedLines, unusedLines } from "./tables.js";

/** Options as commander passes them: numbers are still text. */
export interface MeshCommandOptions extends RepairCommandOptions {
  readonly output: string;
  readonly from?: string;
  readonly to?: string;
  readonly size?: string;
  readonly growth?: string;
  readonly source?: readonly string[];
  readonly gradation?: string;
  readonly background?: string;
  readonly refineSurface?: boolean;
  readonly order?: FrontOrder;
  /** False after --no-filters. */
  readonly filters: boolean;
  readonly optimize?: Optimization;
  /** Degrees. */
  readonly requireAngle?: string;
  readonly report?: string;
  readonly keepPartial?: boolean;
  readonly quiet?: boolean;
}

const EXIT_CODES: Readonly<Record<MeshStatus, number>> = {
  done: ExitCode.meshed,
  stalled: ExitCode.notCompleted,
  cancelled: ExitCode.notCompleted,
  "invalid-input": ExitCode.invalidInput,
};

/** Result of a command. */
interface Outcome {
  readonly report: MeshReport;
  readonly exitCode: number;
  /** File that contains the mesh, if any. */
  readonly written: string | null;
  /** Changes of the surface, if a repair was requested. */
  readonly changes?: readonly RepairChange[] | undefined;
  readonly refinement?: RefinementCounts | undefined;
}

/** Result of a requested refinement of the surface. */
interface RefinementCounts {
  /** Number of triangles before and after. */
  readonly given: number;
  readonly triangles: number;
  readonly splitEdges: number;
}

/** Runs the command; resolves with the exit code. */
export async function meshFile(input: string, options: MeshCommandOptions): Promise<number> {
  const whereFailed = (failure: unknown) => failed(failure, input, options.background);
  const failedCheck = await checkReportPath(input, options).catch(whereFailed);
  // If the report cannot be written, that failure is not reported in it either.
  if (failedCheck !== undefined) return failedCheck.exitCode;
  const outcome = await meshAndWrite(input, options).catch(whereFailed);
  const { changes, refinement, written } = outcome;
  const done = { ...(changes && { repair: changes }), ...(refinement && { refinement }) };
  const report = { ...outcome.report, ...done, input, output: written };
  const isOut = options.report === undefined || (await writeReport(options.report, report));
  return isOut ? outcome.exitCode : ExitCode.notCompleted;
}

const projectRefinement = invalidOption(
  "--refine-surface",
  "--refine-surface is for surfaces, but the input is a project",
  "Omit it: patches are meshed with the target sizes.",
);

const projectGrowth = invalidOption(
  "--growth",
  "--growth is for surfaces, but the input is a project",
  "Omit it: the background grid and the sources of the project define the growth.",
);

async function meshAndWrite(input: string, options: MeshCommandOptions): Promise<Outcome> {
  const isQuiet = options.quiet === true;
  const meshOptions = readOptions(options);
  const requiredAngle = requiredAngleOf(options);
  const repair = repairOptions(options);
  await checkMeshPaths(input, options);
  const given = await readModel(input, options.from);
  if (given.kind === "project") {
    if (options.refineSurface === true) refuseOptions([projectRefinement]);
    if (options.growth !== undefined) refuseOptions([projectGrowth]);
    refuseRepair(repair, "a project");
  }
  const grid = options.background === undefined ? undefined : await readGrid(options.background);
  if (grid?.kind === "volume" && !isQuiet) {
    for (const line of unusedLines(grid.volume)) print(`note: ${options.background}: ${line}`);
  }
  const { model, changes } = await withRepair(given, repair);
  if (changes !== undefined && !isQuiet) printChanges(input, changes);
  if (given.kind === "surface" && !isQuiet) {
    for (const line of readingLines(given.surface)) print(`note: ${input}: ${line}`);
  }
  const isRefined = options.refineSurface === true;
  const {
    result,
    model: meshed,
    refinement,
  } = await mesh(model, meshOptions, {
    isQuiet,
    isRefined,
    given: grid && { file: options.background ?? "", grid },
  });
  if (refinement !== undefined && !isQuiet) printRefinement(input, refinement);
  const { report } = result;
  printWithGrid({ input, background: options.background }, report.diagnostics, isQuiet);
  const shouldWrite = mayWrite(result, options);
  const written = shouldWrite && (await writeResult(input, options, result, meshed)) ? options.output : null;
  if (!isQuiet && report.status !== "invalid-input") print(summary(input, report, written, options));
  const isLost = shouldWrite && written === null;
  const poor = requiredAngleError(report, requiredAngle, options);
  printDiagnostics(input, poor, { isQuiet });
  const exitCode = isLost || poor.length > 0 ? ExitCode.notCompleted : EXIT_CODES[report.status];
  const diagnostics = [...report.diagnostics, ...poor];
  return { report: { ...report, diagnostics }, written, exitCode, changes, refinement };
}

/** Returns an error if the finished mesh has a smaller dihedral angle than required. */
function requiredAngleError(
  { status, dihedral: { min: angle } }: MeshReport,
  required: number,
  { optimize }: MeshCommandOptions,
): Diagnostic[] {
  if (status !== "done" || angle >= required) return [];
  const thorough = optimize === "thorough" ? "" : "--optimize thorough, or ";
  const error: DiagnosticOf<"required-angle"> = {
    code: "required-angle",
    severity: "error",
    message: `The smallest dihedral angle is ${angle.toFixed(2)}°, but --require-angle is ${required}°`,
    remedy: `Use ${thorough}a surface without needles and narrow gaps.`,
    entities: [],
    data: { angle, required },
  };
  return [error];
}

/** Prints diagnostics about the background grid with the name of its own file. */
function printWithGrid(
  { input, background }: { readonly input: string; readonly background: string | undefined },
  diagnostics: readonly Diagnostic[],
  isQuiet: boolean,
): void {
  const isOfGrid = ({ code, entities: [first] }: Diagnostic) =>
    background !== undefined &&
    (code === "empty-background-grid" || first?.kind.startsWith("background-") === true);
  printDiagnostics(background ?? input, diagnostics.filter(isOfGrid), { isQuiet });
  printDiagnostics(
    input,
    diagnostics.filter((found) => !isOfGrid(found)),
    { isQuiet },
  );
}

function printRefinement(input: string, { given, triangles, splitEdges }: RefinementCounts): void {
  print(
    `${input}: refined: ${plural(given, "triangle")} before, ${triangles} after, ${plural(splitEdges, "edge")} split`,
  );
}

async function withRepair(
  given: Input,
  repair: RepairOptions | undefined,
): Promise<{ readonly model: Input; readonly changes?: readonly RepairChange[] | undefined }> {
  if (given.kind === "project" || repair === undefined) return { model: given };
  const { surface, changes } = await withMesher((mesher) => repaired(mesher, given.surface, repair));
  return { model: { kind: "surface", surface }, changes };
}

/**
 * Prints the failure of a run that threw; returns its outcome. Rethrows a failure that is neither the input's nor
 * the engine's.
 */
function failed(failure: unknown, input: string, background: string | undefined): Outcome {
  const invalid = asInvalidInput(failure, input);
  if (invalid !== undefined) {
    printWithGrid({ input: invalid.subject, background }, invalid.diagnostics, true);
    return invalidInput(invalid.diagnostics);
  }
  const engine = asEngineFailure(failure);
  if (engine === undefined) throw failure;
  printDiagnostics(input, [engine], { isQuiet: true });
  return { report: emptyReport("stalled", [engine]), exitCode: ExitCode.notCompleted, written: null };
}

function invalidInput(diagnostics: readonly Diagnostic[]): Outcome {
  return {
    report: emptyReport("invalid-input", diagnostics),
    exitCode: ExitCode.invalidInput,
    written: null,
  };
}

function readOptions(options: MeshCommandOptions): MeshOptions {
  const meshOptions: MeshOptions = {
    size: numberIn(options.size),
    growth: numberIn(options.growth),
    gradation: numberIn(options.gradation),
    innerShells: options.innerShells,
    order: options.order,
    filters: options.filters,
    optimization: options.optimize,
    ...sourcesIn(options.source),
  };
  const wrong = checkOptions(meshOptions);
  if (options.size !== undefined && options.background !== undefined) {
    const message = "--size and --background exclude each other";
    wrong.push(invalidOption("--background", message, "Use one of them."));
  }
  refuseOptions(wrong);
  return meshOptions;
}

/** Dihedral angle of the regular tetrahedron, in degrees, rounded down: the limit of any mesh. */
const MAX_REQUIRED_ANGLE = 70;

/** Returns the angle of `--require-angle` in degrees, 0 if it is not given. Throws an InvalidInput. */
function requiredAngleOf({ requireAngle }: MeshCommandOptions): number {
  const angle = Number(numberIn(requireAngle) ?? 0);
  if (angle >= 0 && angle <= MAX_REQUIRED_ANGLE) return angle;
  const message = `the required angle is "${requireAngle}"`;
  const remedy = `Use an angle from 0 to ${MAX_REQUIRED_ANGLE} degrees.`;
  throw new InvalidInput("command line", [invalidOption("--require-angle", message, remedy)]);
}

/** Returns the sources as a background grid without nodes, which has no other effect. */
function sourcesIn(texts: readonly string[] | undefined): Pick<MeshOptions, "background"> {
  if (texts === undefined) return {};
  const none = new Float64Array();
  const sources = texts.map(sourceIn);
  return { background: { points: none, sizes: none, tetrahedra: new Uint32Array(), sources } };
}

/** Parses `x,y,z,size[,distance[,growth]]`. Throws an InvalidInput. */
function sourceIn(text: string, index: number): ProjectSource {
  const numbers = text.split(",").map(numberIn);
  const [x, y, z, size, distance, growth] = numbers;
  if (numbers.length > 6 || x === undefined || y === undefined || z === undefined || size === undefined) {
    const remedy =
      "Use x,y,z,size and optionally a distance and a growth, for example --source 0,0,1,0.05,0.2.";
    throw new InvalidInput("command line", [invalidOption("--source", `invalid source "${text}"`, remedy)]);
  }
  return { id: index + 1, type: "point", positions: [[x, y, z]], size, distance, growth };
}

async function checkMeshPaths(input: string, options: MeshCommandOptions): Promise<void> {
  const { output, from, to, background } = options;
  await refuseFolder(output);
  writableName(output, to, ["volume"]);
  const written = outputFiles(output, to, "the mesh");
  const grid = background === undefined ? [] : inputFiles(background, undefined, "the background grid");
  await checkNoOverwrite([...inputFiles(input, from), ...grid], written);
  await checkWritable(written);
}

async function checkReportPath(input: string, options: MeshCommandOptions): Promise<undefined> {
  const { report, output, background, from, to } = options;
  if (report === undefined) return;
  await checkOutput(report);
  const kept = [
    ...outputFiles(output, to, "the mesh"),
    ...inputFiles(input, from),
    ...(background === undefined ? [] : inputFiles(background, undefined, "the background grid")),
  ];
  await checkNoOverwrite(kept, [{ words: "the report", file: report }]);
}

/** Background grid in the form of its file. */
interface GivenGrid {
  readonly file: string;
  readonly grid: GridInput;
}

interface MeshingOptions {
  readonly isQuiet: boolean;
  readonly isRefined: boolean;
  readonly given: GivenGrid | undefined;
}

/** Result, and the model that was meshed after repair and refinement. */
interface Meshed {
  readonly result: MeshResult;
  readonly model: Input;
  readonly refinement?: RefinementCounts;
}

async function mesh(
  model: Input,
  options: MeshOptions,
  { isQuiet, isRefined, given }: MeshingOptions,
): Promise<Meshed> {
  const stop = new AbortController();
  // Listen once: a second signal takes the default action and ends the process immediately.
  const onSignal = () => stop.abort();
  process.once("SIGINT", onSignal).once("SIGTERM", onSignal);
  // Load before the progress bar appears: a failure must not leave a bar or a hidden cursor behind.
  const mesher = await createMesher().catch((failure: unknown) => {
    process.off("SIGINT", onSignal).off("SIGTERM", onSignal);
    throw failure;
  });
  const bar = process.stderr.isTTY && !isQuiet ? new ProgressBar() : undefined;
  const control: RunControl = { signal: stop.signal, onProgress: (progress) => bar?.update(progress) };
  try {
    const all = given === undefined ? options : await withGrid(mesher, options, given);
    if (stop.signal.aborted) return { result: emptyResult("cancelled"), model };
    if (model.kind === "project") {
      return { result: await mesher.meshProject(model.project, all, control), model };
    }
    if (!isRefined) return { result: await mesher.fillSurface(model.surface, all, control), model };
    // Inspect before refining, so that diagnostics use the triangle indices of the given surface.
    const { innerShells } = options;
    const found = await mesher.inspectSurface(model.surface, { innerShells }, control);
    if (!found.isFillable) return { result: emptyResult("invalid-input", found.diagnostics), model };
    // The volume helps to estimate the number of elements only if the orientation of all triangles is known.
    const volume = found.flippedTriangles > 0 ? undefined : found.volume;
    const { surface, counts } = await refined(mesher, model.surface, { ...all, volume }, control);
    const result = await mesher.fillSurface(surface, all, control);
    return { result, model: { kind: "surface", surface }, refinement: counts };
  } catch (failure) {
    if (!(failure instanceof MesherError) || failure.code !== "cancelled") throw failure;
    return { result: emptyResult("cancelled"), model };
  } finally {
    bar?.stop();
    mesher.dispose();
    process.off("SIGINT", onSignal).off("SIGTERM", onSignal);
  }
}

async function refined(
  mesher: Mesher,
  given: SurfaceFile,
  options: RefineOptions,
  control: RunControl,
): Promise<{ readonly surface: SurfaceFile; readonly counts: RefinementCounts }> {
  const refinement = await mesher.refineSurface(given, options, control);
  const surface = repairedSurface(given, refinement);
  const counts = {
    given: given.triangles.length / 3,
    triangles: surface.triangles.length / 3,
    splitEdges: refinement.splitEdges,
  };
  return { surface, counts };
}

async function withGrid(mesher: Mesher, options: MeshOptions, given: GivenGrid): Promise<MeshOptions> {
  const grid = await gridArrays(mesher, given.file, given.grid);
  const wrong = checkBackground(grid);
  if (wrong.length > 0) throw new InvalidInput(given.file, wrong);
  const sources = [...(grid.sources ?? []), ...(options.background?.sources ?? [])];
  return { ...options, background: { ...grid, sources } };
}

function mayWrite({ report, volume }: MeshResult, { keepPartial }: MeshCommandOptions): boolean {
  return report.status === "done" || (keepPartial === true && volume.tetrahedra.length > 0);
}

async function writeResult(
  input: string,
  { output, to, quiet: isQuiet = false }: MeshCommandOptions,
  result: MeshResult,
  model: Input,
): Promise<boolean> {
  const name = writableName(output, to, ["volume"]);
  const mesh = fileMeshOf(result, model);
  if (!isQuiet && model.kind === "surface") {
    for (const line of unmeshedLines(model.surface, mesh)) print(`note: ${input}: ${line}`);
  }
  const files = await writeMesh(mesh, name);
  return succeeds(() => writeAll(files, { input, output, name, isQuiet }));
}

type CommandReport = MeshReport & { readonly input: string; readonly output: string | null };

async function writeReport(file: string, report: CommandReport): Promise<boolean> {
  const text = `${JSON.stringify(report, null, 2)}\n`;
  return succeeds(() => writeOutput(file, text));
}

/** Returns whether writing succeeded; if not, prints the failure. */
async function succeeds(write: () => Promise<void>): Promise<boolean> {
  try {
    await write();
    return true;
  } catch (failure) {
    if (!(failure instanceof FileError)) throw failure;
    const { file, message, remedy } = failure;
    printDiagnostics(file, [packageDiagnostic("unreadable-input", message, remedy)], { isQuiet: true });
    return false;
  }
}

function summary(
  input: string,
  report: MeshReport,
  written: string | null,
  { keepPartial }: MeshCommandOptions,
): string {
  const { status, tetrahedra, nodes, dihedral, radiusRatio, quality, seconds } = report;
  const { outOfRange, limitedByBoundary: limited } = quality;
  const shapes = [
    `dihedral angles ${dihedral.min.toFixed(1)}° to ${dihedral.max.toFixed(1)}°`,
    `mean radius ratio ${radiusRatio.mean.toFixed(3)}`,
  ];
  const parts = [
    plural(tetrahedra, "tetrahedron"),
    plural(nodes, "node"),
    ...(tetrahedra > 0 ? shapes : []),
    ...(status === "done" ? [`mean edge ${quality.edges.mean.toFixed(2)} of the target`] : []),
    ...(outOfRange > 0 ? [`${outOfRange} outside 30° to 135°`] : []),
    ...(limited.count > 0 ? [`${limited.count} of them limited by the boundary`] : []),
    `${seconds.total.toFixed(2)} s`,
  ].join(", ");
  const where = written ?? unwritten();
  return `${input}: ${status}, ${parts} -> ${where}`;

  function unwritten(): string {
    if (status === "done") return "not written";
    if (tetrahedra === 0) return "no mesh to write";
    return keepPartial === true ? "not written" : "not written; --keep-partial writes the partial mesh";
  }
}
