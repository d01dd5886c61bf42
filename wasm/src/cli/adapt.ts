/** `tetrafront adapt`: adapts a mesh, or the mesh of a model, to a metric, to layers along patches or to a solution. */
import { checkAdaptOptions } from "../api/mesh-options.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { MeshAdaptation, MetricStatistics } from "../mesh/adaptation.js";
import type { LayeredMesh, PatchLayers } from "../mesh/layered-mesh.js";
import type { Mesh } from "../mesh/mesh.js";
import { withBoundary, writableName, writeMeshTo } from "./convert.js";
import { refuseFolder, STANDARD_STREAM, writeToStandardOutput } from "./files.js";
import { isCadInput, isProject, numberIn, readMeshFile, refuseOptions } from "./input.js";
import { meshInput } from "./mesh.js";
import { ExitCode, failedOutcome, InvalidInput, jsonPieces, print, printDiagnostics } from "./messages.js";
import { checkNoOverwrite, checkWritable, inputFiles, outputFiles } from "./paths.js";
import { withRun } from "./run.js";
import type { CycleReport } from "./cycle-folder.js";
import { layerLimitsIn, layersIn, layersOf, layersText } from "./layers.js";
import {
  type CycleCommandOptions,
  cycleOptions,
  refuseCycleOptions,
  runCycles,
  WITH_LAYERS,
} from "./cycles.js";
import type { UnitOptions } from "./units.js";

/** Options as commander passes them. */
export interface AdaptCommandOptions extends UnitOptions, CycleCommandOptions {
  readonly background?: string;
  readonly layers?: readonly string[];
  readonly threads?: string;
  readonly from?: string;
  readonly to?: string;
  readonly json?: boolean;
  readonly quiet?: boolean;
}

/** Result of the command, as printed by `--json`. */
interface Outcome
  extends
    Partial<Pick<MeshAdaptation, "isPartial" | "before" | "after">>,
    Partial<Pick<LayeredMesh, "layers" | "largestAspect">> {
  /** What each cycle with a solver made, or the number of cycles for layers; and the folder of the files of cycles. */
  readonly cycles?: readonly CycleReport[] | number;
  readonly folder?: string;
  /** The written file, if any. */
  readonly output: string | null;
  readonly diagnostics: readonly Diagnostic[];
  readonly exitCode: number;
}

/** Largest angle that an edge of the boundary spans on the curved faces of a CAD file: its area and volume are then good to 0.1 %. */
const ANGLE_PER_EDGE = "6";

/** Runs the command; resolves with the exit code. */
export async function adaptFile(input: string, options: AdaptCommandOptions): Promise<number> {
  const outcome = await adaptAndWrite(input, options).catch((failure: unknown) =>
    failedOutcome(failure, input),
  );
  const { exitCode, ...report } = outcome;
  if (options.json === true) {
    for (const piece of jsonPieces({ input, ...report })) await writeToStandardOutput(piece);
  }
  return exitCode;
}

async function adaptAndWrite(input: string, options: AdaptCommandOptions): Promise<Outcome> {
  const { background, solver, layers } = options;
  if (solver !== undefined) {
    refuseBackgroundBeside(background);
    return adaptInCycles(input, { ...options, solver });
  }
  if (layers !== undefined) {
    refuseCycleOptions(options, WITH_LAYERS);
    return adaptOnce(input, options, layersIn(layers));
  }
  if (background === undefined) {
    const message = "none of --background, --layers and --solver is given";
    const remedy =
      "Add --background with a metric, --layers for layers along patches, or --solver with the command of a solver and --elements or --error.";
    refuseOptions([invalidOption("--background", message, remedy)]);
  }
  refuseCycleOptions(options);
  return adaptOnce(input, options, []);
}

function refuseBackgroundBeside(background: string | undefined): void {
  if (background === undefined) return;
  const message = "--background and --solver exclude each other";
  refuseOptions([invalidOption("--solver", message, "Use one of them.")]);
}

/** Adapts the mesh of a model to the solution of a solver, cycle by cycle. */
async function adaptInCycles(
  input: string,
  options: AdaptCommandOptions & { readonly solver: string },
): Promise<Outcome> {
  const { output } = options;
  const isQuiet = options.quiet === true || options.json === true;
  const chosen = cycleOptions(options);
  const name = await checkPaths(input, options);
  const { mesh, cycles, folder } = await runCycles({ input, options, chosen, isQuiet }, () =>
    readOrMesh(input, options, { isQuiet, isRemeshed: true }),
  );
  const notes = await writeMeshTo({ input, output, name, isQuiet }, mesh);
  const text = `${plural(cycles.length, "cycle")}; ${plural(mesh.tetrahedra.length / 4, "tetrahedron")}`;
  if (!isQuiet) print(`${input}: ${text} -> ${output}; all files of the cycles are in ${folder}`);
  return { output, cycles, folder, diagnostics: notes, exitCode: ExitCode.meshed };
}

/** Adapts the mesh of a model to the metric of a background mesh, or to layers. */
async function adaptOnce(
  input: string,
  options: AdaptCommandOptions,
  layers: readonly PatchLayers[],
): Promise<Outcome> {
  const { output } = options;
  const isQuiet = options.quiet === true || options.json === true;
  const chosen = { leastQuality: numberIn(options.quality), sweeps: numberIn(options.sweeps) };
  refuseOptions(checkAdaptOptions(chosen));
  const limits = { ...chosen, ...(layers.length > 0 && layerLimitsIn(options)) };
  const name = await checkPaths(input, options);
  const background = await readBackground(options);
  const given = await readOrMesh(input, options, { isQuiet, isRemeshed: false });
  const made = await withRun(isQuiet, (mesher, controlOf): Promise<MeshAdaptation | LayeredMesh> => {
    const control = { ...controlOf("adapt"), partial: true };
    if (layers.length === 0 && background !== undefined)
      return mesher.adaptMesh(given, background, chosen, control);
    return mesher.addLayers(given, layersOf(input, given, layers), { ...limits, background }, control);
  });
  const { mesh, isPartial, before, after, diagnostics } = made;
  const notes = await writeMeshTo({ input, output, name, isQuiet }, mesh);
  printDiagnostics(input, diagnostics, { isQuiet });
  if (isPartial) print(`${input}: stopped; the mesh made so far is valid, and was written`);
  const isLayered = "layers" in made;
  if (!isQuiet) print(`${input}: ${adaptationText(before, after)} -> ${output}`);
  if (!isQuiet && isLayered) print(`${input}: ${layersText(made)}`);
  const exitCode = isPartial ? ExitCode.notCompleted : ExitCode.meshed;
  return {
    output,
    isPartial,
    before,
    after,
    ...(isLayered && { layers: made.layers, largestAspect: made.largestAspect, cycles: made.cycles }),
    diagnostics: [...notes, ...diagnostics],
    exitCode,
  };
}

async function readBackground({ background: file }: AdaptCommandOptions): Promise<Mesh | undefined> {
  if (file === undefined) return undefined;
  const background = await readMeshFile(file);
  requireTetrahedra(file, background);
  return background;
}

/** Checks the output before any work; returns a name whose extension selects its format. */
async function checkPaths(input: string, options: AdaptCommandOptions): Promise<string> {
  const { background, output, from, to, json } = options;
  if (json === true && output === STANDARD_STREAM) {
    const message = "--json and the mesh cannot both be written to standard output";
    refuseOptions([invalidOption("--json", message, "Use -o with the name of a file.")]);
  }
  await refuseFolder(output);
  const name = writableName(output, to, ["volume"]);
  const written = outputFiles(output, to);
  await checkNoOverwrite(
    [
      ...inputFiles(input, from),
      ...(background === undefined ? [] : inputFiles(background, undefined, "the background mesh")),
    ],
    written,
  );
  await checkWritable(written);
  return name;
}

function requireTetrahedra(file: string, mesh: Mesh): void {
  if (mesh.tetrahedra.length > 0) return;
  const remedy = "Use a volume mesh with the metric at its nodes.";
  throw new InvalidInput(file, [
    packageDiagnostic("no-tetrahedra", "the file contains no tetrahedra", remedy),
  ]);
}

interface FirstMeshing {
  readonly isQuiet: boolean;
  /** Whether the triangles of a surface are replaced, so that a solver gets elements inside large faces. */
  readonly isRemeshed: boolean;
}

/** Returns the volume mesh of the file, or meshes the model in it. */
async function readOrMesh(
  input: string,
  options: AdaptCommandOptions,
  { isQuiet, isRemeshed }: FirstMeshing,
): Promise<Mesh> {
  const { from, units, fileUnits, scale } = options;
  const reading = {
    ...(from !== undefined && { from }),
    ...(units !== undefined && { units }),
    ...(fileUnits !== undefined && { fileUnits }),
    ...(scale !== undefined && { scale }),
  };
  const isCad = isCadInput(input, options.from);
  const isDrawn = isProject(input, options.from);
  if (!isCad && !isDrawn) {
    const mesh = await readMeshFile(input, reading);
    if (mesh.tetrahedra.length > 0) return mesh.triangles.length > 0 ? mesh : withBoundary(mesh);
  }
  const remesh = isCad || (isRemeshed && !isDrawn) ? ({ surface: "remesh" } as const) : {};
  const fine = isCad ? { ...remesh, anglePerEdge: ANGLE_PER_EDGE } : remesh;
  const { result } = await meshInput(
    input,
    { ...reading, ...fine, filters: true, optimize: "fast", quiet: true },
    () => Promise.resolve(),
  );
  const { report, mesh } = result;
  if (report.status === "cancelled") {
    throw new MesherError("cancelled", "The call was cancelled.", { reason: undefined });
  }
  if (report.status !== "done") throw new InvalidInput(input, report.diagnostics);
  if (!isQuiet) print(`${input}: ${plural(mesh.tetrahedra.length / 4, "tetrahedron")} to begin with`);
  return mesh;
}

function adaptationText(before: MetricStatistics, after: MetricStatistics): string {
  const percent = (share: number) => `${(100 * share).toFixed(2)} %`;
  return [
    `adapted: ${plural(before.tetrahedra, "tetrahedron")} before, ${after.tetrahedra} after`,
    `${plural(after.nodes, "node")}`,
    `unit edges ${percent(before.unitEdges)} before, ${percent(after.unitEdges)} after`,
    `lengths ${after.shortest.toFixed(3)} to ${after.longest.toFixed(3)}`,
    `least quality in the metric ${after.leastQuality.toFixed(3)}, mean ${after.meanQuality.toFixed(3)}`,
  ].join("; ");
}
