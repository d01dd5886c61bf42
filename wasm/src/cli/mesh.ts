/** `tetrafront mesh`: reads, meshes and writes; prints a summary. */
import { fileMeshOf } from "../api/generated-mesh.js";
import { writeMesh } from "../api/mesh-files.js";
import type { MeshOptions, SplitOptions } from "../api/option-types.js";
import { checkOptions } from "../api/options.js";
import { emptyReport, emptyResult } from "../api/report.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { RunControl } from "../engine/control.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { FrontOrder, Optimization } from "../generated/constants.js";
import type { RepairChange } from "../mesh/inspection.js";
import type { MeshReport, MeshResult, MeshStatus } from "../mesh/report.js";
import { writableName, writeAll } from "./convert.js";
import { elementOrderFor, type ElementOrderOption } from "./element-order.js";
import { checkOutput, FileError, refuseFolder, writeOutput } from "./files.js";
import { withMesher } from "./grids.js";
import { type Input, isCadInput, numberIn, refuseOptions, surfaceIn } from "./input.js";
import { readGiven, subjectOf } from "./joined-inputs.js";
import { asInvalidInput, asEngineFailure, ExitCode, print, printDiagnostics } from "./messages.js";
import { checkNoOverwrite, checkWritable, givenFiles, outputFiles } from "./paths.js";
import {
  type RefinementCounts,
  refinementText,
  refuseRemeshing,
  type RemeshCommandOptions,
  remeshOptions,
  type RemeshReport,
  remeshText,
  type SurfaceTreatment,
} from "./remeshing.js";
import {
  type Preparation,
  preparedSurface,
  printChanges,
  refuseRepair,
  type RepairCommandOptions,
  repairOptions,
} from "./repair.js";
import { located } from "./regions.js";
import { hasSolids } from "./solid-regions.js";
import { requiredAngleError, requiredAngleOf } from "./required-angle.js";
import type { UnitOptions } from "./units.js";
import { EXACT_REPAIR, filledBest, hasWelded, remeshedBest } from "./best-repair.js";
import { withRun } from "./run.js";
import {
  checkSizes,
  type GivenGrid,
  gridFiles,
  printWithGrid,
  readGivenGrid,
  type SizeCommandOptions,
  sizesIn,
  withGrid,
} from "./sizes.js";
import { refuseSplit, type SplitCommandOptions, splitOptions, splitText, withSplit } from "./splitting.js";
import { anglesText, readingLines, unmeshedLines } from "./tables.js";
import { type TreatedSurface, treatedSurface } from "./treatment.js";

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
  const report = { ...outcome.report, ...done, input, ...inputs, output: written };
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
  const made = await meshInput(input, options, () => checkMeshPaths(input, options));
  const {
    given,
    treatment,
    result,
    model: meshed,
    found,
    changes,
    repairDeviation,
    refinement,
    remesh,
  } = made;
  const { report } = result;
  const shouldWrite = mayWrite(result, options);
  const written = shouldWrite && (await writeResult(input, options, result, meshed)) ? options.output : null;
  if (!isQuiet && report.status !== "invalid-input") print(summary(subject, report, written, options));
  const isLost = shouldWrite && written === null;
  const poor = requiredAngleError(
    report,
    requiredAngle,
    options,
    given.kind === "project" || treatment === "remesh",
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
export interface MeshedInput extends Meshed {
  readonly given: Input;
  readonly treatment: SurfaceTreatment | undefined;
  /** Diagnostics from before the run. */
  readonly found: readonly Diagnostic[];
  readonly changes?: readonly RepairChange[] | undefined;
  readonly repairDeviation?: number | undefined;
}

/** What a recorded run does with the front. */
export type FrontRecording = Pick<RunControl, "onTrace" | "experiment">;

/**
 * Reads, repairs and meshes an input, and prints what was done. `checkPaths` is called before anything is read. `recording`
 * receives the steps of the front, and may change its rules.
 */
export async function meshInput(
  input: string,
  options: Omit<MeshCommandOptions, "output">,
  checkPaths: () => Promise<void>,
  recording: FrontRecording = {},
): Promise<MeshedInput> {
  const isQuiet = options.quiet === true;
  const meshOptions = readOptions(options);
  const repair = repairOptions(options);
  const split = splitOptions(options);
  const isCad = isCadInput(input, options.from);
  const treatment = options.surface ?? (isCad ? "remesh" : undefined);
  if (treatment === "remesh") remeshOptions(options, meshOptions);
  else refuseRemeshing(options);
  await checkPaths();
  const subject = subjectOf(input, options.joined);
  const { given, diagnostics: read } = await readGiven(input, options, meshOptions.size);
  if (given.kind === "project") {
    if (options.surface !== undefined) refuseOptions([projectSurface]);
    const hasBodies = (given.project.bodies ?? []).length > 0;
    if (options.growth !== undefined && !hasBodies) refuseOptions([projectGrowth]);
    refuseRepair(repair, "a project");
    refuseSplit(split);
  }
  const grid = await readGivenGrid(options, isQuiet);
  const { innerShells } = options;
  const isRemeshed = treatment === "remesh";
  const isRepairImplied = repair === undefined && (isRemeshed || isCad);
  const repairing = { input: subject, repair, split, innerShells, isRepairImplied, isRemeshed };
  const treated = await withRepair(given, repairing);
  const isWelded = isRepairImplied && isRemeshed && hasWelded(surfaceIn(given), treated);
  const exact = isWelded ? () => withRepair(given, { ...repairing, isExact: true }) : undefined;
  const { split: splitWords } = treated;
  if (!isQuiet) printChanges(subject, treated);
  if (splitWords !== undefined && !isQuiet) print(`${subject}: ${splitWords}`);
  if (given.kind === "surface" && !isQuiet) {
    for (const line of readingLines(given.surface)) print(`note: ${subject}: ${line}`);
  }
  const meshing = { isQuiet, treatment, remeshing: options, grid, recording };
  const made = await mesh(treated, exact, meshOptions, meshing).catch((failure: unknown) => {
    // Warnings of the repair say why the surface is invalid.
    printWithGrid({ input: subject, background: options.background }, treated.located ?? [], isQuiet);
    throw failure;
  });
  const { refinement, remesh, repaired: taken } = made;
  const { changes, repairDeviation, located: foundLater = [] } = taken;
  const found = [...read, ...foundLater];
  if (taken !== treated && !isQuiet) print(`repair: ${subject}: ${EXACT_REPAIR}`);
  if (taken !== treated && !isQuiet) printChanges(subject, taken);
  if (refinement !== undefined && !isQuiet) print(`${subject}: ${refinementText(refinement)}`);
  if (remesh !== undefined && !isQuiet) print(`${subject}: ${remeshText(remesh, "--report FILE")}`);
  if (remesh?.isPartial === true) print(`${subject}: ${REMESHING_STOPPED}`);
  const { diagnostics } = made.result.report;
  printWithGrid({ input: subject, background: options.background }, [...found, ...diagnostics], isQuiet);
  return { ...made, given, treatment, found, changes, repairDeviation };
}

const REMESHING_STOPPED =
  "stopped while the surface was remeshed, before the first tetrahedron; tetrafront remesh writes the surface that it has made so far";

/** Input after its repair and the splitting of its patches. */
interface Repaired {
  readonly model: Input;
  readonly changes?: readonly RepairChange[] | undefined;
  readonly repairDeviation?: number | undefined;
  /** Description of the splitting. */
  readonly split?: string | undefined;
  /** Warnings about solids that overlap and about region points. */
  readonly located?: readonly Diagnostic[];
}

interface Repairing extends Preparation {
  readonly split: SplitOptions | undefined;
}

async function withRepair(given: Input, repairing: Repairing): Promise<Repaired> {
  const { repair, split, innerShells, isRepairImplied } = repairing;
  if (given.kind === "project") return { model: given };
  const hasPoints = given.surface.regionPoints !== undefined;
  const isAssembly = hasSolids(given.surface);
  const isUnchanged = repair === undefined && split === undefined && !isRepairImplied && !hasPoints;
  if (isUnchanged && !isAssembly) return { model: given };
  return withMesher(async (mesher) => {
    const {
      surface: whole,
      changes,
      repairDeviation,
      warnings = [],
    } = await preparedSurface(mesher, given.surface, repairing);
    const divided = await withSplit(mesher, whole, split);
    const words = split && splitText(whole, divided);
    const { surface, diagnostics } = await located(mesher, divided, innerShells);
    return {
      model: { kind: "surface", surface },
      changes,
      repairDeviation,
      split: words,
      located: [...warnings, ...diagnostics],
    };
  });
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

function readOptions(options: Omit<MeshCommandOptions, "output">): MeshOptions {
  const meshOptions: MeshOptions = {
    ...sizesIn(options),
    gradation: numberIn(options.gradation),
    maxVolume: numberIn(options.maxVolume),
    innerShells: options.innerShells,
    order: options.order,
    filters: options.filters,
    optimization: options.optimize,
  };
  refuseOptions([...checkOptions(meshOptions), ...checkSizes(options)]);
  return meshOptions;
}

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

interface MeshingOptions {
  readonly isQuiet: boolean;
  readonly treatment: SurfaceTreatment | undefined;
  readonly remeshing: RemeshCommandOptions;
  readonly grid: GivenGrid | undefined;
  readonly recording: FrontRecording;
}

/** Result, and the model that was meshed after repair, refinement or remeshing. */
interface Meshed {
  readonly result: MeshResult;
  readonly model: Input;
  readonly refinement?: RefinementCounts;
  readonly remesh?: RemeshReport;
}

/** `exact`: another repair, for triangles that are poor after a remeshing. */
async function mesh(
  given: Repaired,
  exact: (() => Promise<Repaired>) | undefined,
  options: MeshOptions,
  meshing: MeshingOptions,
): Promise<Meshed & { readonly repaired: Repaired }> {
  const { model } = given;
  try {
    return await withRun(meshing.isQuiet, async (mesher, controlOf) => {
      const all = await withGrid(mesher, options, meshing.grid);
      const control = { ...controlOf(), ...meshing.recording };
      if (control.signal.aborted) return { result: emptyResult("cancelled"), model, repaired: given };
      if (model.kind === "project") {
        return { result: await mesher.meshProject(model.project, all, control), model, repaired: given };
      }
      const best = await remeshedBest(given, exact, ({ model: one }) =>
        treatedSurface(mesher, surfaceIn(one), { ...meshing, options: all, controlOf }),
      );
      const fill = async ({ surface, invalid, diagnostics = [] }: TreatedSurface): Promise<MeshResult> =>
        invalid === undefined
          ? withDiagnostics(await mesher.fillSurface(surface, all, control), diagnostics)
          : emptyResult("invalid-input", invalid);
      // A trace shows one front, also one that stalls.
      const tried =
        meshing.recording.onTrace === undefined ? best : { ...best, welded: undefined, exact: undefined };
      const { made, prepared, result } = await filledBest(tried, fill);
      const { surface, invalid, diagnostics: _, ...report } = made;
      if (invalid !== undefined) return { result, model, repaired: prepared };
      return { result, model: { kind: "surface", surface }, repaired: prepared, ...report };
    });
  } catch (failure) {
    if (!(failure instanceof MesherError) || failure.code !== "cancelled") throw failure;
    return { result: emptyResult("cancelled"), model, repaired: given };
  }
}

/** Adds the diagnostics of the treatment, which came first. */
function withDiagnostics(result: MeshResult, first: readonly Diagnostic[]): MeshResult {
  const { report } = result;
  return { ...result, report: { ...report, diagnostics: [...first, ...report.diagnostics] } };
}

function mayWrite({ report, volume }: MeshResult, { keepPartial }: MeshCommandOptions): boolean {
  return report.status === "done" || (keepPartial === true && volume.tetrahedra.length > 0);
}

async function writeResult(
  input: string,
  options: MeshCommandOptions,
  result: MeshResult,
  model: Input,
): Promise<boolean> {
  const { output, to, quiet: isQuiet = false } = options;
  const subject = subjectOf(input, options.joined);
  const name = writableName(output, to, ["volume"]);
  const isAssembly = isCadInput(input, options.from) || (options.joined ?? []).length > 1;
  const mesh = fileMeshOf(result, { ...model, interfacePatches: isAssembly });
  if (!isQuiet && model.kind === "surface") {
    for (const line of unmeshedLines(model.surface, mesh)) print(`note: ${subject}: ${line}`);
  }
  const files = await writeMesh(mesh, name, { elementOrder: elementOrderFor(options, name) });
  return succeeds(() => writeAll(files, { input: subject, output, name, isQuiet }));
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
