/** `tetrafront remesh`: replaces the triangles of a surface by well-shaped ones, and checks the written file. */
import { readingNotes } from "../api/reading-notes.js";
import { hasWelded, remeshedBest } from "../api/best-repair.js";
import { located } from "../api/located-surface.js";
import { readSurface, writeMesh } from "../api/mesh-files.js";
import type { Mesher } from "../api/mesher-interface.js";
import { withControl } from "../api/surface-mesher.js";
import type { Mesh } from "../mesh/mesh.js";
import { sharedFacesNote } from "../api/solids.js";
import { hasSolids } from "../api/stated-solids.js";
import { madeFillable, type PreparedSurface, repaired } from "../api/surface-preparation.js";
import type { RemeshReport } from "../api/meshed-surface.js";
import { remeshed } from "../api/surface-treatment.js";
import { remeshText, splitText } from "../api/treatment-texts.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { countOf } from "../diagnostics/lines.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { WrittenFile } from "../formats/file-format.js";
import { formatOf } from "../formats/file-formats.js";
import type { InnerShells } from "../generated/constants.js";
import type { SurfaceInput } from "../mesh/mesh.js";
import type { RepairChange } from "../mesh/inspection.js";
import { writableName } from "./convert.js";
import { refuseFolder, STANDARD_STREAM, writeOutput, writeToStandardOutput } from "./files.js";
import { readModel, refuseOptions } from "./input.js";
import { ExitCode, failedOutcome, InvalidInput, jsonPieces, print, printDiagnostics } from "./messages.js";
import { enterStage } from "./stages.js";
import { checkNoOverwrite, checkWritable, inputFiles, outputFiles } from "./paths.js";
import { type RemeshCommandOptions, remeshOptions } from "./remeshing.js";
import { EXACT_REPAIR, printChanges, type RepairCommandOptions, repairOptions } from "./repair.js";
import type { UnitOptions } from "./units.js";
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
import { type SplitCommandOptions, splitOptions, withSplit } from "./splitting.js";

/** Options as commander passes them: numbers are still text. */
export interface RemeshFileOptions
  extends RepairCommandOptions, RemeshCommandOptions, SizeCommandOptions, SplitCommandOptions, UnitOptions {
  readonly output: string;
  readonly from?: string;
  readonly to?: string;
  readonly json?: boolean;
  readonly quiet?: boolean;
}

/** Result of the command, as printed by `--json`. */
interface Outcome {
  /** The written file, if any. */
  readonly output: string | null;
  readonly remesh?: RemeshReport;
  readonly repair?: readonly RepairChange[] | undefined;
  readonly diagnostics: readonly Diagnostic[];
  readonly exitCode: number;
}

/** Runs the command; resolves with the exit code. */
export async function remeshFile(input: string, options: RemeshFileOptions): Promise<number> {
  const outcome = await remeshAndWrite(input, options).catch((failure: unknown) =>
    failedOutcome(failure, input, (subject, diagnostics) =>
      printWithGrid({ input: subject, background: options.background }, diagnostics, true),
    ),
  );
  const { exitCode, ...report } = outcome;
  if (options.json === true) {
    for (const piece of jsonPieces({ input, ...report })) await writeToStandardOutput(piece);
  }
  return exitCode;
}

/** Share of a remeshing that nothing follows, except for a second one if its triangles are poor. */
const ONLY = 0.95;

async function remeshAndWrite(input: string, options: RemeshFileOptions): Promise<Outcome> {
  const { output, innerShells } = options;
  const isQuiet = options.quiet === true || options.json === true;
  refuseOptions(checkSizes(options));
  const sizes = remeshOptions(options, { ...sizesIn(options), innerShells });
  const repair = repairOptions(options);
  const split = splitOptions(options);
  const name = await checkPaths(input, options);
  const given = await readModel(input, options, sizes.size);
  if (given.kind === "project") throw new InvalidInput(input, [projectGiven]);
  const grid = await readGivenGrid(options, isQuiet);
  return withRun(isQuiet, async (mesher, controlOf) => {
    const checked = withControl(mesher, () => controlOf("check"));
    const prepare = async (isExact: boolean) => {
      const treated =
        repair === undefined
          ? await madeFillable(checked, given.surface, { innerShells, isRemeshed: true, isExact })
          : await repaired(checked, given.surface, repair);
      const divided = await withSplit(checked, treated.surface, split);
      const { surface, diagnostics } = await located(checked, divided, innerShells);
      return { treated, divided, surface, diagnostics: [...diagnostics, ...sharedFacesOf(surface)] };
    };
    const welded = await prepare(false);
    if (!isQuiet) printChanges(input, welded.treated);
    if (!isQuiet) for (const line of readingNotes(given.surface)) print(`note: ${input}: ${line}`);
    if (split !== undefined && !isQuiet) {
      const [before, after] = [welded.treated.surface, welded.divided].map(({ patches }) => patches.length);
      print(`${input}: ${splitText({ before: before ?? 0, after: after ?? 0 })}`);
    }
    const told = problemsOf(welded);
    printDiagnostics(input, told, { isQuiet });
    const withSizes = await withGrid(mesher, sizes, grid);
    const hasExact = repair === undefined && hasWelded(given.surface, welded.treated);
    const { made, prepared, isExact } = await remeshedBest(
      welded,
      hasExact ? () => prepare(true) : undefined,
      ({ surface }) =>
        remeshed(mesher, surface, withSizes, {
          ...controlOf("remesh", ONLY),
          partial: true,
        }),
      { partial: true },
    );
    const { changes, repairDeviation } = prepared.treated;
    const found = problemsOf(prepared);
    if (isExact && !isQuiet) {
      print(`repair: ${input}: ${EXACT_REPAIR}`);
      printChanges(input, prepared.treated);
    }
    if (isExact) {
      const isTold = ({ message }: Diagnostic): boolean => told.some((one) => one.message === message);
      const others = found.filter((one) => !isTold(one));
      printDiagnostics(input, others, { isQuiet });
    }
    const files = await writeMesh(made.surface, name);
    const diagnostics = await problemsInFile(mesher, files, made.surface, { name, innerShells });
    enterStage(`writing ${output}`);
    for (const { notes } of files) printDiagnostics(input, notes, { isQuiet });
    for (const { fileName, bytes } of files) await writeOutput(fileName === name ? output : fileName, bytes);
    const { isPartial } = made.remesh;
    if (isPartial) print(`${input}: stopped; the surface made so far is valid, and was written`);
    if (!isQuiet) print(`${input}: ${remeshText(made.remesh, "--json")} -> ${output}`);
    printDiagnostics(input, made.diagnostics, { isQuiet });
    printDiagnostics(output, diagnostics, { isQuiet });
    const isComplete = !isPartial && countOf(diagnostics, "error") === 0;
    const exitCode = isComplete ? ExitCode.meshed : ExitCode.notCompleted;
    const notes = files.flatMap((file) => file.notes);
    return {
      output,
      remesh: made.remesh,
      repair: changes,
      repairDeviation,
      diagnostics: [...found, ...notes, ...made.diagnostics, ...diagnostics],
      exitCode,
    };
  });
}

const sharedFacesOf = (surface: Mesh) => (hasSolids(surface) ? sharedFacesNote(surface) : []);

function problemsOf(prepared: {
  readonly treated: Pick<PreparedSurface, "warnings">;
  readonly diagnostics: readonly Diagnostic[];
}): readonly Diagnostic[] {
  return [...(prepared.treated.warnings ?? []), ...prepared.diagnostics];
}

const projectGiven = packageDiagnostic(
  "unreadable-input",
  "the input is a project, but only surfaces can be remeshed",
  "Mesh it with `tetrafront mesh`, which triangulates its patches.",
);

/** Checks the output before any work; returns a name whose extension selects its format. */
async function checkPaths(input: string, options: RemeshFileOptions): Promise<string> {
  const { output, from, to, json } = options;
  if (json === true && output === STANDARD_STREAM) {
    const message = "--json and the surface cannot both be written to standard output";
    refuseOptions([invalidOption("--json", message, "Use -o with the name of a file.")]);
  }
  await refuseFolder(output);
  const name = writableName(output, to, ["surface"]);
  const written = outputFiles(output, to);
  await checkNoOverwrite([...inputFiles(input, from), ...gridFiles(options)], written);
  await checkWritable(written);
  return name;
}

interface FileContext {
  /** Name whose extension selects the format. */
  readonly name: string;
  readonly innerShells: InnerShells | undefined;
}

/**
 * Reads the file as another program would, and returns an error if the surface is no longer valid: formats with single
 * precision round its nodes.
 */
async function problemsInFile(
  mesher: Mesher,
  [file]: readonly WrittenFile[],
  surface: SurfaceInput,
  { name, innerShells }: FileContext,
): Promise<Diagnostic[]> {
  if (file === undefined || formatOf(name)?.readable.includes("surface") !== true) return [];
  const read = await readSurface(file.bytes, { fileName: name });
  if (read.success && hasSameCorners(read.value, surface)) return [];
  const reason = read.success
    ? (await mesher.inspectSurface(read.value, { innerShells, maxDiagnostics: 1 })).diagnostics.find(
        ({ severity }) => severity === "error",
      )?.message
    : read.errors[0].message;
  if (reason === undefined) return [];
  const message = `the surface is no longer valid after the rounding of its file format: ${reason}`;
  const remedy = "Use a format with double precision, such as .ply, .obj or .off.";
  return [packageDiagnostic("invalid-when-rounded", message, remedy)];
}

/** Returns whether the triangles of two surfaces have the same corners in the same order. */
function hasSameCorners(one: SurfaceInput, other: SurfaceInput): boolean {
  if (one.triangles.length !== other.triangles.length) return false;
  return one.triangles.every((node, i) => {
    const [a, b] = [3 * node, 3 * (other.triangles[i] ?? 0)];
    return [0, 1, 2].every((axis) => one.points[a + axis] === other.points[b + axis]);
  });
}
