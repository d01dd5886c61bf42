/** `tetrafront improve`: improves the elements of a volume mesh, and compares their shapes before and after. */
import { readingNotes } from "../api/reading-notes.js";
import type { ImproveOptions } from "../api/option-types.js";
import { checkImproveOptions } from "../api/mesh-options.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { omittedDataMessage } from "../formats/format-limits.js";
import type { Mesh } from "../mesh/mesh.js";
import type { MeshImprovement, MeshShapes } from "../mesh/improvement.js";
import { withBoundary, writableName, writeMeshTo } from "./convert.js";
import { refuseFolder, STANDARD_STREAM, writeToStandardOutput } from "./files.js";
import { numberIn, readMeshFile, refuseOptions, type InputOptions } from "./input.js";
import type { UnitOptions } from "./units.js";
import { ExitCode, failedOutcome, InvalidInput, jsonPieces, print, printDiagnostics } from "./messages.js";
import { checkNoOverwrite, checkWritable, inputFiles, outputFiles } from "./paths.js";
import { withRun } from "./run.js";
import { angleText, mixedOrientationLines } from "./tables.js";

/** Options as commander passes them. */
export interface ImproveCommandOptions extends UnitOptions {
  readonly output: string;
  readonly from?: string;
  readonly to?: string;
  readonly optimize?: Exclude<ImproveOptions["optimization"], undefined>;
  readonly maxGrowth?: string;
  readonly json?: boolean;
  readonly quiet?: boolean;
}

/** Result of the command, as printed by `--json`. */
interface Outcome extends Partial<
  Pick<
    MeshImprovement,
    "isImproved" | "isPartial" | "isGrowthLimited" | "orientedTetrahedra" | "before" | "after"
  >
> {
  /** The written file, if any. */
  readonly output: string | null;
  readonly diagnostics: readonly Diagnostic[];
  readonly exitCode: number;
}

/** Runs the command; resolves with the exit code. */
export async function improveFile(input: string, options: ImproveCommandOptions): Promise<number> {
  const outcome = await improveAndWrite(input, options).catch((failure: unknown) =>
    failedOutcome(failure, input),
  );
  const { exitCode, ...report } = outcome;
  if (options.json === true) {
    for (const piece of jsonPieces({ input, ...report })) await writeToStandardOutput(piece);
  }
  return exitCode;
}

async function improveAndWrite(input: string, options: ImproveCommandOptions): Promise<Outcome> {
  const { output } = options;
  const isQuiet = options.quiet === true || options.json === true;
  const name = await checkPaths(input, options);
  const chosen = { optimization: options.optimize, maxGrowth: numberIn(options.maxGrowth) };
  refuseOptions(checkImproveOptions(chosen));
  const given = await readVolumeMesh(input, options);
  if (!isQuiet) {
    for (const line of [...mixedOrientationLines(given), ...readingNotes(given)]) {
      print(`note: ${input}: ${line}`);
    }
  }
  const made = await withRun(isQuiet, (mesher, controlOf) =>
    mesher.improveMesh(given, chosen, { ...controlOf("improve"), partial: true }),
  );
  const { mesh: better, nodeOrigin: _, diagnostics: found, ...figures } = made;
  const diagnostics = found.map(withRemedy);
  const mesh = made.isImproved ? better : given;
  const whole = mesh.triangles.length > 0 ? mesh : await withBoundary(mesh);
  const notes = await writeMeshTo({ input, output, name, isQuiet }, whole);
  printDiagnostics(input, diagnostics, { isQuiet });
  if (made.isPartial) print(`${input}: stopped; the mesh made so far is valid, and was written`);
  if (!isQuiet) {
    const left = [...given.nodeData.keys()];
    if (made.isImproved && left.length > 0) print(`note: ${input}: ${omittedDataMessage(left)}`);
    print(`${input}: ${improvementText(made)} -> ${output}`);
  }
  const exitCode = made.isPartial ? ExitCode.notCompleted : ExitCode.meshed;
  return { output, ...figures, diagnostics: [...notes, ...diagnostics], exitCode };
}

/** Checks the output before any work; returns a name whose extension selects its format. */
async function checkPaths(input: string, options: ImproveCommandOptions): Promise<string> {
  const { output, from, to, json } = options;
  if (json === true && output === STANDARD_STREAM) {
    const message = "--json and the mesh cannot both be written to standard output";
    refuseOptions([invalidOption("--json", message, "Use -o with the name of a file.")]);
  }
  await refuseFolder(output);
  const name = writableName(output, to, ["volume"]);
  const written = outputFiles(output, to);
  await checkNoOverwrite(inputFiles(input, from), written);
  await checkWritable(written);
  return name;
}

async function readVolumeMesh(input: string, options: InputOptions): Promise<Mesh> {
  const mesh = await readMeshFile(input, options);
  if (mesh.tetrahedra.length > 0) return mesh;
  const remedy = "Use a volume mesh; `tetrafront mesh` makes one of a surface.";
  const none = packageDiagnostic("no-tetrahedra", "the file contains no tetrahedra", remedy);
  throw new InvalidInput(input, [none]);
}

/** Returns a diagnostic whose remedy names the option of the command line. */
function withRemedy(diagnostic: Diagnostic): Diagnostic {
  if (diagnostic.code !== "growth-limited") return diagnostic;
  return { ...diagnostic, remedy: "Permit more with --max-growth." };
}

/** Returns the share of elements outside 30 to 135 degrees: it never grows, but their number may, with that of all elements. */
function shareText({ outOfRange, tetrahedra }: MeshShapes): string {
  return `${Number(((100 * outOfRange) / tetrahedra).toPrecision(3))} %`;
}

/** Returns by how much the number of elements has changed, if that can be seen. */
function growthText({ tetrahedra: was }: MeshShapes, { tetrahedra: is }: MeshShapes): string {
  const percent = (100 * (is - was)) / was;
  return Math.abs(percent) < 0.05
    ? ""
    : ` (${percent > 0 ? "+" : "\u2212"}${Math.abs(percent).toFixed(1)} %)`;
}

/** Describes the elements before and after. */
function improvementText({ isImproved, before, after }: MeshImprovement): string {
  const shapes = [
    changed("smallest dihedral angle", ({ dihedral }) => angleText(dihedral.min, 1, Math.floor)),
    changed("largest", ({ dihedral }) => angleText(dihedral.max, 1, Math.ceil)),
    changed("least radius ratio", ({ radiusRatio }) => radiusRatio.min.toFixed(3)),
    changed("mean radius ratio", ({ radiusRatio }) => radiusRatio.mean.toFixed(3)),
    changed("outside 30° to 135°", (of) => `${of.outOfRange} (${shareText(of)})`),
  ];
  const changes = [
    `${plural(before.tetrahedra, "tetrahedron")} before, ${after.tetrahedra} after${growthText(before, after)}`,
    `${plural(before.nodes, "node")} before, ${after.nodes} after`,
    ...shapes.map(({ text }) => text),
  ];
  const limited =
    after.limitedByBoundary > 0 ? [`${after.limitedByBoundary} of them limited by the boundary`] : [];
  // Gains below the digits shown are no reason to replace a mesh.
  const much = shapes.some(({ isChanged }) => isChanged) ? "improved" : "improved slightly";
  return `${isImproved ? much : "unchanged"}: ${[...changes, ...limited].join("; ")}`;

  function changed(what: string, text: (shapes: MeshShapes) => string) {
    const [was, is] = [text(before), text(after)];
    const isChanged = was !== is;
    return { isChanged, text: isChanged ? `${what} ${was} before, ${is} after` : `${what} ${was}` };
  }
}
