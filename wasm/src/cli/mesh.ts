/** `tetrafront mesh`: reads, meshes, writes, and says what happened. */
import { writableName, writeAll } from "./convert.js";
import { checkOutput, FileProblem, refuseFolder, writeOutput } from "./files.js";
import {
  gridArrays,
  numberIn,
  readGrid,
  readModel,
  refuseOptions,
  type GridInput,
  type Input,
} from "./input.js";
import { asBadInput, asEngineFailure, BadInput, ExitCode, say, tell } from "./messages.js";
import { checkApart, checkWritable, inputFiles, outputFiles } from "./places.js";
import { leftOutLines, readingLines, unusedLines } from "./tables.js";
import { ProgressBar } from "./progress-bar.js";
import { refuseRepair, repaired, repairOptions, tellChanges, type RepairCommandOptions } from "./repair.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { fileMeshOf } from "../formats/file-mesh.js";
import { writeMesh } from "../formats/mesh-files.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import { withMesher } from "./grids.js";
import type { RepairChange, RepairOptions } from "../api/inspection.js";
import { checkBackground } from "../api/input-checks.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { createMesher } from "../api/mesher.js";
import type { ProjectSource } from "../project/schema.js";
import { checkOptions } from "../api/options.js";
import { plural } from "../base/plural.js";
import { repairedSurface } from "../api/repaired-surface.js";
import { emptyReport, emptyResult } from "../api/report.js";
import type {
  Diagnostic,
  FrontOrder,
  Mesher,
  MeshOptions,
  MeshReport,
  MeshResult,
  MeshStatus,
  Optimization,
  RefineOptions,
  RunControl,
} from "../api/types.js";

/** As commander hands them over: numbers are still text. */
export interface MeshCommandOptions extends RepairCommandOptions {
  readonly output: string;
  readonly from?: string;
  readonly to?: string;
  readonly size?: string;
  readonly grading?: string;
  /** The older name of `grading`. */
  readonly growth?: string;
  readonly source?: readonly string[];
  readonly gradation?: string;
  readonly background?: string;
  readonly refineSurface?: boolean;
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

/** What became of a command. */
interface Outcome {
  readonly report: MeshReport;
  readonly exitCode: number;
  /** The file the mesh is in, if any. */
  readonly written: string | null;
  /** Of the surface, where a repair was asked for. */
  readonly changes?: readonly RepairChange[] | undefined;
  readonly refinement?: RefinementFigures | undefined;
}

/** What became of the surface, where its refinement was asked for. */
interface RefinementFigures {
  /** Triangles before and after. */
  readonly given: number;
  readonly triangles: number;
  readonly splitEdges: number;
}

/** Runs the command; resolves with the exit code. */
export async function meshFile(input: string, options: MeshCommandOptions): Promise<number> {
  const whereFailed = (failure: unknown) => failed(failure, input, options.background);
  const place = await checkReportPlace(input, options).catch(whereFailed);
  // Without a place for it there will be no report, not even about that.
  if (place !== undefined) return place.exitCode;
  const outcome = await meshAndWrite(input, options).catch(whereFailed);
  const { changes, refinement, written } = outcome;
  const done = { ...(changes && { repair: changes }), ...(refinement && { refinement }) };
  const report = { ...outcome.report, ...done, input, output: written };
  const isOut = options.report === undefined || (await writeReport(options.report, report));
  return isOut ? outcome.exitCode : ExitCode.notCompleted;
}

const refinedProject = invalidOption(
  "--refine-surface",
  "--refine-surface is for surfaces, and this is a project",
  "Leave it out: patches are meshed to the sizes wanted.",
);

const gradedProject = invalidOption(
  "--grading",
  "--grading is for surfaces, and this is a project",
  "Leave it out: sizes grow as the project's grid, or its sources, say.",
);

async function meshAndWrite(input: string, options: MeshCommandOptions): Promise<Outcome> {
  const isQuiet = options.quiet === true;
  const meshOptions = readOptions(options);
  const repair = repairOptions(options);
  await checkMeshPlace(input, options);
  const given = await readModel(input, options.from);
  if (given.kind === "project") {
    if (options.refineSurface === true) refuseOptions([refinedProject]);
    if ((options.grading ?? options.growth) !== undefined) refuseOptions([gradedProject]);
    refuseRepair(repair, "a project");
  }
  const grid = options.background === undefined ? undefined : await readGrid(options.background);
  if (grid?.kind === "volume" && !isQuiet) {
    for (const line of unusedLines(grid.volume)) say(`note: ${options.background}: ${line}`);
  }
  const { model, changes } = await withRepair(given, repair);
  if (changes !== undefined && !isQuiet) tellChanges(input, changes);
  if (given.kind === "surface" && !isQuiet) {
    for (const line of readingLines(given.surface)) say(`note: ${input}: ${line}`);
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
  if (refinement !== undefined && !isQuiet) tellRefinement(input, refinement);
  const { report } = result;
  tellOf({ input, background: options.background }, report.diagnostics, isQuiet);
  const isWanted = mayWrite(result, options);
  const written = isWanted && (await writeResult(input, options, result, meshed)) ? options.output : null;
  if (!isQuiet && report.status !== "invalid-input") say(summary(input, report, written, options));
  const isLost = isWanted && written === null;
  const exitCode = isLost ? ExitCode.notCompleted : EXIT_CODES[report.status];
  return { report, written, exitCode, changes, refinement };
}

/** What is wrong with the background grid is told of its own file. */
function tellOf(
  { input, background }: { readonly input: string; readonly background: string | undefined },
  diagnostics: readonly Diagnostic[],
  isQuiet: boolean,
): void {
  const isOfGrid = ({ code, entities: [first] }: Diagnostic) =>
    background !== undefined &&
    (code === "empty-background-grid" || first?.kind.startsWith("background-") === true);
  tell(background ?? input, diagnostics.filter(isOfGrid), { isQuiet });
  tell(
    input,
    diagnostics.filter((found) => !isOfGrid(found)),
    { isQuiet },
  );
}

function tellRefinement(input: string, { given, triangles, splitEdges }: RefinementFigures): void {
  say(
    `${input}: refined: ${plural(given, "triangle")} before, ${triangles} after; halved ${plural(splitEdges, "edge")}.`,
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

/** What to report of a run that threw; the messages are out by then. Our own mistakes pass through. */
function failed(failure: unknown, input: string, background: string | undefined): Outcome {
  const bad = asBadInput(failure, input);
  if (bad !== undefined) {
    tellOf({ input: bad.subject, background }, bad.diagnostics, true);
    return badInput(bad.diagnostics);
  }
  const engine = asEngineFailure(failure);
  if (engine === undefined) throw failure;
  tell(input, [engine], { isQuiet: true });
  return { report: emptyReport("stalled", [engine]), exitCode: ExitCode.notCompleted, written: null };
}

function badInput(diagnostics: readonly Diagnostic[]): Outcome {
  return { report: emptyReport("invalid-input", diagnostics), exitCode: ExitCode.badInput, written: null };
}

function readOptions(options: MeshCommandOptions): MeshOptions {
  const meshOptions: MeshOptions = {
    size: numberIn(options.size),
    growth: numberIn(options.grading ?? options.growth),
    gradation: numberIn(options.gradation),
    innerShells: options.enclosed,
    order: options.order,
    filters: options.filters,
    optimization: options.optimize,
    ...sourcesIn(options.source),
  };
  const wrong = checkOptions(meshOptions);
  if (options.size !== undefined && options.background !== undefined) {
    const message = "both --size and --background are given";
    wrong.push(invalidOption("--background", message, "Give one of them."));
  }
  refuseOptions(wrong);
  return meshOptions;
}

/** Sources of size as a background grid without nodes, which leaves all else as it is. */
function sourcesIn(texts: readonly string[] | undefined): Pick<MeshOptions, "background"> {
  if (texts === undefined) return {};
  const none = new Float64Array();
  const sources = texts.map(sourceIn);
  return { background: { points: none, sizes: none, tetrahedra: new Uint32Array(), sources } };
}

/** `x,y,z,size[,distance[,growth]]`. Throws a BadInput. */
function sourceIn(text: string, index: number): ProjectSource {
  const numbers = text.split(",").map(numberIn);
  const [x, y, z, size, distance, growth] = numbers;
  if (numbers.length > 6 || x === undefined || y === undefined || z === undefined || size === undefined) {
    const remedy = "Give x,y,z,size, then a distance and a growth if need be: --source 0,0,1,0.05,0.2";
    throw new BadInput("command line", [invalidOption("--source", `the source is "${text}"`, remedy)]);
  }
  return { id: index + 1, type: "point", positions: [[x, y, z]], size, distance, growth };
}

async function checkMeshPlace(input: string, options: MeshCommandOptions): Promise<void> {
  const { output, from, to, background } = options;
  await refuseFolder(output);
  writableName(output, to, ["volume"]);
  const written = outputFiles(output, to, "the mesh");
  const grid = background === undefined ? [] : inputFiles(background, undefined, "the background grid");
  await checkApart([...inputFiles(input, from), ...grid], written);
  await checkWritable(written);
}

async function checkReportPlace(input: string, options: MeshCommandOptions): Promise<undefined> {
  const { report, output, background, from, to } = options;
  if (report === undefined) return;
  await checkOutput(report);
  const kept = [
    ...outputFiles(output, to, "the mesh"),
    ...inputFiles(input, from),
    ...(background === undefined ? [] : inputFiles(background, undefined, "the background grid")),
  ];
  await checkApart(kept, [{ words: "the report", file: report }]);
}

/** A background grid still to be made of what its file holds. */
interface GivenGrid {
  readonly file: string;
  readonly grid: GridInput;
}

interface MeshingOptions {
  readonly isQuiet: boolean;
  readonly isRefined: boolean;
  readonly given: GivenGrid | undefined;
}

/** A mesh, and what was meshed in the end. */
interface Meshed {
  readonly result: MeshResult;
  readonly model: Input;
  readonly refinement?: RefinementFigures;
}

async function mesh(
  model: Input,
  options: MeshOptions,
  { isQuiet, isRefined, given }: MeshingOptions,
): Promise<Meshed> {
  const stop = new AbortController();
  // Once: who asks again while the mesher stops wants to be out at once, and gets the default.
  const onSignal = () => stop.abort();
  process.once("SIGINT", onSignal).once("SIGTERM", onSignal);
  // A failure to load leaves neither a bar nor a hidden cursor behind.
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
    // Told in the numbers of what was given.
    const { innerShells } = options;
    const found = await mesher.inspectSurface(model.surface, { innerShells }, control);
    if (!found.isFillable) return { result: emptyResult("invalid-input", found.diagnostics), model };
    // Samples tell the inside by how triangles are turned.
    const volume = found.flippedTriangles > 0 ? undefined : found.volume;
    const { surface, figures } = await refined(mesher, model.surface, { ...all, volume }, control);
    const result = await mesher.fillSurface(surface, all, control);
    return { result, model: { kind: "surface", surface }, refinement: figures };
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
): Promise<{ readonly surface: SurfaceFile; readonly figures: RefinementFigures }> {
  const refinement = await mesher.refineSurface(given, options, control);
  const surface = repairedSurface(given, refinement);
  const figures = {
    given: given.triangles.length / 3,
    triangles: surface.triangles.length / 3,
    splitEdges: refinement.splitEdges,
  };
  return { surface, figures };
}

async function withGrid(mesher: Mesher, options: MeshOptions, given: GivenGrid): Promise<MeshOptions> {
  const grid = await gridArrays(mesher, given.file, given.grid);
  const wrong = checkBackground(grid);
  if (wrong.length > 0) throw new BadInput(given.file, wrong);
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
    for (const line of leftOutLines(model.surface, mesh)) say(`note: ${input}: ${line}`);
  }
  const files = await writeMesh(mesh, name);
  return succeeds(() => writeAll(files, { input, output, name, isQuiet }));
}

type CommandReport = MeshReport & { readonly input: string; readonly output: string | null };

async function writeReport(file: string, report: CommandReport): Promise<boolean> {
  const text = `${JSON.stringify(report, null, 2)}\n`;
  return succeeds(() => writeOutput(file, text));
}

/** Whether it could be written; if not, the user is told. */
async function succeeds(write: () => Promise<void>): Promise<boolean> {
  try {
    await write();
    return true;
  } catch (failure) {
    if (!(failure instanceof FileProblem)) throw failure;
    say(`error: ${failure.file}: ${failure.message}. ${failure.remedy}`);
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
  const figures = [
    plural(tetrahedra, "tetrahedron"),
    plural(nodes, "point"),
    ...(tetrahedra > 0 ? shapes : []),
    ...(status === "done" ? [`mean edge ${quality.edges.mean.toFixed(2)} of the wanted`] : []),
    ...(outOfRange > 0 ? [`${outOfRange} beyond 30° to 135°`] : []),
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
