/** `tetrafront mesh`: reads, meshes and writes; prints a summary. */
import { readingNotes, unmeshedNotes } from "../api/reading-notes.js";
import type { SurfaceMeshOptions, SurfaceTreatment } from "../api/option-types.js";
import { checkGradation, growthOf } from "../api/mesh-options.js";
import { emptyReport, emptyResult } from "../api/report.js";
import { checkSurfaceMeshOptions, projectPart, repairPart, splitPart } from "../api/surface-mesh-options.js";
import { withControl } from "../api/surface-mesher.js";
import type { Step } from "../api/whole-progress.js";
import { secondOrderText } from "../api/second-order-mesh.js";
import { filledSurface, type ReadySurface, readySurface } from "../api/surface-meshing.js";
import type { MeshedSurface, RefinementCounts, RemeshReport } from "../api/meshed-surface.js";
import { refinementText, remeshText, splitText } from "../api/treatment-texts.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { RunControl } from "../engine/control.js";
import type { FrontOrder, Interior, Optimization } from "../generated/constants.js";
import type { Mesh } from "../mesh/mesh.js";
import type { RepairChange } from "../mesh/inspection.js";
import type { MeshReport, MeshResult, MeshStatus } from "../mesh/report.js";
import type { Project } from "../project/project-types.js";
import { asTypedDiagnostic, inCommandLineWords } from "./command-line-words.js";
import { formatOf } from "../formats/file-formats.js";
import { writableName, writeMeshTo } from "./convert.js";
import { elementOrderFor, type ElementOrderOption } from "./element-order.js";
import { checkOutput, FileError, refuseFolder, writeOutput } from "./files.js";
import { formatName, type Input, isCadInput, numberIn, refuseOptions } from "./input.js";
import { readGiven, subjectOf } from "./joined-inputs.js";
import { asInvalidInput, asEngineFailure, ExitCode, print, printDiagnostics } from "./messages.js";
import { checkNoOverwrite, checkWritable, givenFiles, outputFiles } from "./paths.js";
import { EXACT_REPAIR, printChanges, refuseRepair, type RepairCommandOptions } from "./repair.js";
import { refuseRemeshing, type RemeshCommandOptions, remeshSettingsIn } from "./remeshing.js";
import { requiredAngleError, requiredAngleOf } from "./required-angle.js";
import { withRun } from "./run.js";
import {
  checkSizes,
  gridFiles,
  printWithGrid,
  readGivenGrid,
  type SizeCommandOptions,
  sizesIn,
  withGrid,
} from "./sizes.js";
import { refuseSplit, type SplitCommandOptions } from "./splitting.js";
import { anglesText } from "./tables.js";
import type { UnitOptions } from "./units.js";

/** Options as commander passes them: numbers are still text. */
export interface MeshCommandOptions
  extends
    RepairCommandOptions,
    RemeshCommandOptions,
    SizeCommandOptions,
    SplitCommandOptions,
    ElementOrderOption,
    UnitOptions {
  readonly output: string;
  readonly from?: string;
  readonly to?: string;
  readonly gradation?: string;
  readonly maxVolume?: string;
  readonly surface?: SurfaceTreatment;
  readonly order?: FrontOrder;
  /** False after --no-filters. */
  readonly filters: boolean;
  readonly optimize?: Optimization;
  readonly interior?: Interior;
  readonly threads?: string;
  /** Degrees. */
  readonly requireAngle?: string;
  readonly report?: string;
  readonly joined?: readonly string[];
  readonly keepPartial?: boolean;
  readonly quiet?: boolean;
}

/** Exit code of each end of a run. */
export const EXIT_CODES: Readonly<Record<MeshStatus, number>> = {
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
  readonly repairDeviation?: number | undefined;
  readonly refinement?: RefinementCounts | undefined;
  readonly remesh?: RemeshReport | undefined;
}

/** Runs the command; resolves with the exit code. */
export async function meshFile(input: string, options: MeshCommandOptions): Promise<number> {
  const { background, joined } = options;
  const whereFailed = (failure: unknown) => failed(failure, subjectOf(input, joined), background);
  const failedCheck = await checkReportPath(input, options).catch(whereFailed);
  // If the report cannot be written, that failure is not reported in it either.
  if (failedCheck !== undefined) return failedCheck.exitCode;
  const outcome = await meshAndWrite(input, options).catch(whereFailed);
  const { changes, repairDeviation, refinement, remesh, written } = outcome;
  const done = {
    ...(changes && { repair: changes, repairDeviation }),
    ...(refinement && { refinement }),
    ...(remesh && { remesh }),
  };
  const inputs = joined === undefined ? {} : { inputs: joined };
  const diagnostics = outcome.report.diagnostics.map(asTypedDiagnostic);
  const report = { ...outcome.report, diagnostics, ...done, input, ...inputs, output: written };
  const isOut = options.report === undefined || (await writeReport(options.report, report));
  return isOut ? outcome.exitCode : ExitCode.notCompleted;
}

const projectSurface = invalidOption(
  "--surface",
  "--surface is for surfaces, but the input is a project",
  "Omit it: patches are meshed with the target sizes, and each body has a treatment of its own.",
);

const projectGrowth = invalidOption(
  "--growth",
  "--growth is for surfaces, but the input is a project without bodies",
  "Omit it: the background grid and the sources of the project define the growth.",
);

async function meshAndWrite(input: string, options: MeshCommandOptions): Promise<Outcome> {
  const isQuiet = options.quiet === true;
  const subject = subjectOf(input, options.joined);
  const requiredAngle = requiredAngleOf(options);
  const write: WriteMade = async ({ result, model: meshed }, signal) => {
    const isWritten =
      mayWrite(result, options) && (await writeResult(input, options, result, meshed, signal));
    return isWritten ? options.output : null;
  };
  const streaming = isStreamed(options) ? { inBlocks: true, write } : {};
  const made = await meshInput(input, options, () => checkMeshPaths(input, options), streaming);
  const { given, result, found } = made;
  const { changes, repairDeviation, refinement, remesh } = made.made ?? {};
  const { report } = result;
  const shouldWrite = mayWrite(result, options);
  const { written = await write(made) } = made;
  if (!isQuiet && report.status !== "invalid-input") print(summary(subject, report, written, options));
  const isLost = shouldWrite && written === null;
  const poor = requiredAngleError(
    report,
    requiredAngle,
    options,
    given.kind === "project" || remesh !== undefined,
  );
  printDiagnostics(subject, poor, { isQuiet });
  const exitCode = isLost || poor.length > 0 ? ExitCode.notCompleted : EXIT_CODES[report.status];
  const diagnostics = [...found, ...report.diagnostics, ...poor];
  return {
    report: { ...report, diagnostics },
    written,
    exitCode,
    changes,
    repairDeviation,
    refinement,
    remesh,
  };
}

/** What was read, and what became of it. */
export interface MeshedInput {
  readonly given: Input;
  readonly result: MeshResult;
  /** The model that was meshed, after its repair and remeshing. */
  readonly model: Input;
  /** Diagnostics from before the run. */
  readonly found: readonly Diagnostic[];
  /** What was done to a surface. */
  readonly made?: MeshedSurface | undefined;
  /** File that contains the mesh, or null, if it was to be written before the mesher was disposed of. */
  readonly written?: string | null | undefined;
}

/** What a recorded run does with the front. */
export type FrontRecording = Pick<RunControl, "onTrace" | "experiment">;

/** Writes a mesh if it should be written; returns its file, or null. */
type WriteMade = (
  made: Pick<MeshedInput, "result" | "model">,
  signal?: AbortSignal,
) => Promise<string | null>;

/** What becomes of a finished mesh whose elements stay in the engine: `write` has its file written before the mesher is disposed of. */
interface Streaming extends Pick<RunControl, "inBlocks"> {
  readonly write?: WriteMade;
}

/** Returns whether the elements of a mesh are written while they are read from the engine. Several runs may be needed for a number of them. */
function isStreamed({ output, to, elements, elementOrder }: MeshCommandOptions): boolean {
  const format = formatOf(formatName(output, to));
  return elements === undefined && elementOrder !== "2" && ["vtu", "gmsh"].includes(format?.id ?? "");
}

/**
 * Reads, repairs and meshes an input, and prints what was done. `checkPaths` is called before anything is read. `recording`
 * receives the steps of the front, and may change its rules.
 */
export async function meshInput(
  input: string,
  options: Omit<MeshCommandOptions, "output">,
  checkPaths: () => Promise<void>,
  { write, ...recording }: FrontRecording & Streaming = {},
): Promise<MeshedInput> {
  const isQuiet = options.quiet === true;
  const meshOptions = readOptions(options);
  await checkPaths();
  const subject = subjectOf(input, options.joined);
  const { given, diagnostics: read } = await readGiven(input, options, meshOptions.size);
  if (given.kind === "project") checkForProject(given.project, options, meshOptions);
  const grid = await readGivenGrid(options, isQuiet);
  const early = earlyNotes(subject, isQuiet);
  const run: Parameters<typeof withRun<Omit<MeshedInput, "given">>>[1] = async (mesher, controlOf) => {
    const all = await withGrid(mesher, meshOptions, grid);
    const control = (step?: Step) => ({ ...controlOf(step), ...recording });
    if (control().signal.aborted) return { result: emptyResult("cancelled"), model: given, found: read };
    if (given.kind === "project") {
      const result = await mesher.meshProject(given.project, projectPart(all), control());
      return { result, model: given, found: read };
    }
    const { surface } = given;
    const isCad = isAnyCad(input, options);
    const checked = withControl(mesher, () => controlOf("check"));
    const ready = await readySurface(checked, surface, all, { isCad });
    if (!isQuiet) printReady(subject, surface, ready);
    const hasInterfacePatches = isCad || (options.joined ?? []).length > 1;
    const filling = {
      options: all,
      isCad,
      hasInterfacePatches,
      controlOf: control,
      onTreated: (found: readonly Diagnostic[]) => early.print(found),
      isRecorded: recording.onTrace !== undefined,
    };
    const made = await filledSurface(mesher, surface, ready, filling).catch((failure: unknown) => {
      // Warnings of the repair say why the surface is invalid.
      printWithGrid({ input: subject, background: options.background }, ready.diagnostics, isQuiet);
      throw failure;
    });
    const model = { kind: "surface", surface: made.surface } as const;
    return { result: made, model, found: [...read, ...made.diagnostics], made };
  };
  const meshed = await withRun(isQuiet, async (mesher, controlOf, during) => {
    const ended = await run(mesher, controlOf, during);
    const { signal } = controlOf();
    if (ended.result.blocks === undefined || write === undefined) return ended;
    return { ...ended, written: await during(() => write(ended, signal)) };
  }).catch((failure: unknown) => cancelledOr(failure, given, read));
  if (meshed.made !== undefined) printMade(subject, meshed.made, isQuiet);
  const { secondOrder } = meshed.result.report;
  if (secondOrder !== undefined && !isQuiet)
    print(`${subject}: ${secondOrderText(secondOrder, meshed.result.mesh)}`);
  const { diagnostics } = meshed.result.report;
  const shown = early.others([...meshed.found, ...diagnostics]);
  printWithGrid({ input: subject, background: options.background }, shown, isQuiet);
  return { given, ...meshed };
}

/** Notes that say why a run takes long: they are printed before it, once, and not among `others` at its end. */
function earlyNotes(subject: string, isQuiet: boolean) {
  let isAnyTold = false;
  // An estimate may have come before the number of triangles.
  const isTold = ({ code }: Diagnostic) => isAnyTold && code === "thin-body";
  return {
    print: (found: readonly Diagnostic[]) => {
      const fresh = found.filter((one) => one.code === "thin-body" && !isTold(one));
      printDiagnostics(subject, fresh, { isQuiet });
      isAnyTold ||= fresh.length > 0;
    },
    others: (found: readonly Diagnostic[]) => found.filter((one) => !isTold(one)),
  };
}

/** Returns a cancelled result if the failure means that; rethrows others. */
function cancelledOr(
  failure: unknown,
  model: Input,
  found: readonly Diagnostic[],
): Omit<MeshedInput, "given"> {
  if (!(failure instanceof MesherError) || failure.code !== "cancelled") throw failure;
  return { result: emptyResult("cancelled"), model, found };
}

/** Throws an InvalidInput if an option for surfaces is given for a project. */
function checkForProject(
  { bodies = [] }: Project,
  options: Omit<MeshCommandOptions, "output">,
  meshOptions: SurfaceMeshOptions,
): void {
  if (options.surface !== undefined) refuseOptions([projectSurface]);
  if (options.growth !== undefined && bodies.length === 0) refuseOptions([projectGrowth]);
  refuseRepair(repairPart(meshOptions), "a project");
  refuseSplit(splitPart(meshOptions));
  refuseRemeshing(meshOptions);
}

/** Returns whether the input, or one of those that are joined, describes shapes. */
function isAnyCad(
  input: string,
  { joined = [input], from }: Pick<MeshCommandOptions, "joined" | "from">,
): boolean {
  return joined.some((file) => isCadInput(file, from));
}

/** Prints what was done before the surface is meshed. */
function printReady(subject: string, given: Mesh, ready: ReadySurface): void {
  printChanges(subject, ready);
  const { split } = ready;
  if (split !== undefined) print(`${subject}: ${splitText(split)}`);
  for (const line of readingNotes(given)) print(`note: ${subject}: ${line}`);
}

/** Prints how the surface was changed to be meshed. */
function printMade(subject: string, made: MeshedSurface, isQuiet: boolean): void {
  const { refinement, remesh, isExact } = made;
  if (isExact && !isQuiet) {
    print(`repair: ${subject}: ${EXACT_REPAIR}`);
    printChanges(subject, made);
  }
  if (refinement !== undefined && !isQuiet) print(`${subject}: ${refinementText(refinement)}`);
  if (remesh !== undefined && !isQuiet) print(`${subject}: ${remeshText(remesh, "--report FILE")}`);
  if (remesh?.isPartial === true) print(`${subject}: ${REMESHING_STOPPED}`);
}

const REMESHING_STOPPED =
  "stopped while the surface was remeshed, before the first tetrahedron; tetrafront remesh writes the surface that it has made so far";

/**
 * Prints the failure of a run that threw; returns its outcome. Rethrows a failure that is neither the input's nor
 * the engine's.
 */
function failed(failure: unknown, input: string, background: string | undefined): Outcome {
  const invalid = asInvalidInput(failure, input);
  if (invalid !== undefined) {
    // Warnings are among them only if they may explain the errors.
    printWithGrid({ input: invalid.subject, background }, invalid.diagnostics, false);
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

function readOptions(options: Omit<MeshCommandOptions, "output">): SurfaceMeshOptions {
  const { splitPatches: split } = options;
  const meshOptions: SurfaceMeshOptions = {
    ...sizesIn(options),
    ...remeshSettingsIn(options),
    elements: numberIn(options.elements),
    growth: growthIn(options),
    maxVolume: numberIn(options.maxVolume),
    innerShells: options.innerShells,
    order: options.order,
    filters: options.filters,
    optimization: options.optimize,
    interior: options.interior,
    threads: numberIn(options.threads),
    elementOrder: options.elementOrder === "2" ? 2 : undefined,
    surface: options.surface,
    repair: options.repair,
    weld: numberIn(options.weld),
    fillHoles: numberIn(options.fillHoles),
    splitPatches: typeof split === "string" ? numberIn(split) : split,
  };
  refuseOptions([...checkSurfaceMeshOptions(meshOptions), ...checkSizes(options)]);
  return meshOptions;
}

/** Returns the growth of sizes, which a gradation states as a ratio. Throws an InvalidInput. */
function growthIn({
  growth,
  gradation,
}: Pick<MeshCommandOptions, "growth" | "gradation">): number | undefined {
  const ratio = numberIn(gradation);
  if (ratio === undefined) return numberIn(growth);
  refuseOptions(checkGradation(ratio, "--gradation"));
  if (growth !== undefined) refuseOptions([gradationAndGrowth]);
  return growthOf(ratio);
}

const gradationAndGrowth = invalidOption(
  "--gradation",
  "--gradation and --growth exclude each other: a gradation is 1 + growth",
  "Use one of them.",
);

async function checkMeshPaths(input: string, options: MeshCommandOptions): Promise<void> {
  const { output, to } = options;
  await refuseFolder(output);
  elementOrderFor(options, writableName(output, to, ["volume"]));
  const written = outputFiles(output, to, "the mesh");
  await checkNoOverwrite([...givenFiles(input, options), ...gridFiles(options)], written);
  await checkWritable(written);
}

async function checkReportPath(input: string, options: MeshCommandOptions): Promise<undefined> {
  const { report, output, to } = options;
  if (report === undefined) return;
  await checkOutput(report);
  const kept = [...outputFiles(output, to, "the mesh"), ...givenFiles(input, options), ...gridFiles(options)];
  await checkNoOverwrite(kept, [{ words: "the report", file: report }]);
}

function mayWrite({ report, mesh }: MeshResult, { keepPartial }: MeshCommandOptions): boolean {
  return report.status === "done" || (keepPartial === true && mesh.tetrahedra.length > 0);
}

async function writeResult(
  input: string,
  options: MeshCommandOptions,
  { mesh, blocks }: MeshResult,
  model: Input,
  signal?: AbortSignal,
): Promise<boolean> {
  const { output, to, quiet: isQuiet = false } = options;
  const subject = subjectOf(input, options.joined);
  const name = writableName(output, to, ["volume"]);
  if (!isQuiet && model.kind === "surface") {
    for (const line of unmeshedNotes(model.surface, mesh)) {
      print(`note: ${subject}: ${inCommandLineWords(line)}`);
    }
  }
  const elementOrder = elementOrderFor(options, name);
  return succeeds(() =>
    writeMeshTo({ input: subject, output, name, isQuiet }, mesh, { elementOrder, blocks, signal }),
  );
}

type CommandReport = MeshReport & {
  readonly input: string;
  readonly output: string | null;
};

async function writeReport(file: string, report: CommandReport): Promise<boolean> {
  const text = `${JSON.stringify(report, null, 2)}\n`;
  return succeeds(() => writeOutput(file, text));
}

/** Returns whether writing succeeded; if not, prints the failure. */
async function succeeds(write: () => Promise<unknown>): Promise<boolean> {
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
    `dihedral angles ${anglesText(dihedral, 1)}`,
    `mean radius ratio ${radiusRatio.mean.toFixed(3)}`,
  ];
  const parts = [
    plural(tetrahedra, "tetrahedron"),
    plural(nodes, "node"),
    ...(tetrahedra > 0 ? shapes : []),
    ...(status === "done" ? [`mean edge ${quality.edges.mean.toFixed(2)} of the target`] : []),
    ...(outOfRange > 0 ? [`${outOfRange} outside 30° to 135°`] : []),
    ...(limited.count > 0 ? [`${limited.count} more outside, limited by the boundary`] : []),
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
