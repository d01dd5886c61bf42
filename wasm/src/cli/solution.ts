/** `tetrafront sizes` and `tetrafront transfer`: a background grid from a solution, and a solution on another mesh. */
import { checkGradation, growthOf } from "../api/mesh-options.js";
import { writeMesh } from "../api/mesh-files.js";
import type { SolutionSizeOptions } from "../api/option-types.js";
import { checkSolutionSizeOptions } from "../api/solution-options.js";
import { plural } from "../base/plural.js";
import { short } from "../base/short.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { listed } from "../formats/groups.js";
import { ERROR_NORMS, type ErrorNorm } from "../generated/constants.js";
import type { Mesh } from "../mesh/mesh.js";
import type { FieldValues, SolutionSizes, TransferredFields } from "../mesh/solution.js";
import { writableName, writeAll } from "./convert.js";
import { refuseFolder } from "./files.js";
import { type InputOptions, numberIn, readMeshFile, refuseOptions } from "./input.js";
import { ExitCode, InvalidInput, print, printDiagnostics, reportFailure } from "./messages.js";
import { checkNoOverwrite, checkWritable, inputFiles, outputFiles } from "./paths.js";
import { withRun } from "./run.js";

/** Options as commander passes them. */
interface FieldCommandOptions extends InputOptions {
  readonly output: string;
  readonly to?: string;
  readonly field?: readonly string[];
  readonly quiet?: boolean;
}

export interface SizesCommandOptions extends FieldCommandOptions {
  readonly elements?: string;
  readonly error?: string;
  readonly norm?: string;
  readonly isotropic?: boolean;
  readonly minSize?: string;
  readonly maxSize?: string;
  readonly maxAspect?: string;
  readonly gradation?: string;
}

export interface TransferCommandOptions extends FieldCommandOptions {
  readonly conservative?: boolean;
}

/** Runs `sizes`; resolves with the exit code. */
export async function sizesOfFile(input: string, options: SizesCommandOptions): Promise<number> {
  try {
    const isQuiet = options.quiet === true;
    const chosen = sizeOptions(options);
    const name = await checkedOutput([input], options);
    const mesh = await readElements(input, options);
    const fields = fieldsOf(input, mesh, options.field);
    const made = await withRun(isQuiet, (mesher, controlOf) =>
      mesher.sizeFromSolution(mesh, fields, chosen, controlOf("solution")),
    );
    const { output } = options;
    await writeAll(await writeMesh(made.mesh, name), { input, output, name, isQuiet });
    printDiagnostics(input, made.diagnostics, { isQuiet });
    if (!isQuiet) print(`${input}: ${sizesText(made, fields)} -> ${output}`);
    return ExitCode.meshed;
  } catch (failure) {
    return reportFailure(failure, input);
  }
}

/** Runs `transfer`; resolves with the exit code. */
export async function transferFile(
  input: string,
  target: string,
  options: TransferCommandOptions,
): Promise<number> {
  try {
    const { output, conservative, quiet: isQuiet = false } = options;
    const name = await checkedOutput([input, target], options);
    const from = await readElements(input, options);
    const to = await readElements(target, options);
    const fields = fieldsOf(input, from, options.field);
    const made = await withRun(isQuiet, (mesher, controlOf) =>
      mesher.transferSolution(from, to, fields, { conservative }, controlOf("solution")),
    );
    const nodeData = new Map([
      ...to.nodeData,
      ...made.fields.map(({ name: key = "", components, values }) => [key, { components, values }] as const),
    ]);
    await writeAll(await writeMesh({ ...to, nodeData }, name), { input, output, name, isQuiet });
    if (!isQuiet) {
      for (const line of transferLines(made, conservative === true)) print(`${input}: ${line}`);
      print(`${input}: ${plural(fields.length, "field")} on ${target} -> ${output}`);
    }
    return ExitCode.meshed;
  } catch (failure) {
    return reportFailure(failure, input);
  }
}

/** Returns the options of `sizeFromSolution`. Throws an InvalidInput. */
function sizeOptions(options: SizesCommandOptions): SolutionSizeOptions {
  const { elements, error, norm, isotropic, minSize, maxSize, maxAspect, gradation } = options;
  const ratio = numberIn(gradation);
  if (ratio !== undefined) refuseOptions(checkGradation(ratio));
  const chosen: SolutionSizeOptions = {
    elements: numberIn(elements),
    error: numberIn(error),
    norm: norm === undefined ? undefined : normIn(norm),
    isotropic,
    minSize: numberIn(minSize),
    maxSize: numberIn(maxSize),
    maxAspect: numberIn(maxAspect),
    growth: ratio === undefined ? undefined : growthOf(ratio),
  };
  refuseOptions(checkSolutionSizeOptions(chosen));
  return chosen;
}

/** Norms may be written in capitals, as L2. Others are left to the check of options. */
function normIn(word: string): ErrorNorm {
  return ERROR_NORMS.find((norm) => norm === word.toLowerCase()) ?? (word as ErrorNorm);
}

/** Checks the output before any work; returns a name whose extension selects its format. */
async function checkedOutput(
  inputs: readonly string[],
  { output, from, to }: FieldCommandOptions,
): Promise<string> {
  await refuseFolder(output);
  const name = writableName(output, to, ["volume"]);
  const written = outputFiles(output, to);
  await checkNoOverwrite(
    inputs.flatMap((file) => inputFiles(file, from, inputs.length > 1 ? `the input ${file}` : undefined)),
    written,
  );
  await checkWritable(written);
  return name;
}

async function readElements(input: string, options: InputOptions): Promise<Mesh> {
  const mesh = await readMeshFile(input, options);
  if (mesh.tetrahedra.length > 0) return mesh;
  const remedy = "Use the volume mesh on which the solution was computed.";
  throw new InvalidInput(input, [
    packageDiagnostic("no-tetrahedra", "the file contains no tetrahedra", remedy),
  ]);
}

/** Returns the fields with the given names, by default all. Throws an InvalidInput about a name that the file does not have. */
function fieldsOf(input: string, { nodeData }: Mesh, names: readonly string[] | undefined): FieldValues[] {
  const known = [...nodeData.keys()];
  const has =
    known.length === 0
      ? "The file has no values at nodes."
      : `The file has ${listed(known.map((name) => `"${name}"`))}.`;
  if (known.length === 0) {
    const remedy = "Write the fields of the solver as values at the nodes (VTU: PointData).";
    throw new InvalidInput(input, [packageDiagnostic("unreadable-input", "no field in the file", remedy)]);
  }
  return (names ?? known).map((name) => {
    const data = nodeData.get(name);
    if (data !== undefined) return { ...data, name };
    const message = `there is no field "${name}" at the nodes`;
    throw new InvalidInput(input, [packageDiagnostic("unreadable-input", message, has)]);
  });
}

function sizesText(
  { elements, expectedErrors, metrics }: SolutionSizes,
  fields: readonly FieldValues[],
): string {
  const parts = expectedErrors.map((error, f) => `"${fields[f]?.name ?? ""}" ${short(error, 3)}`);
  return `a metric at ${plural(metrics.length / 6, "node")} for about ${short(elements, 4)} elements; expected error of ${parts.join(", ")}`;
}

function transferLines(
  { fields, integrals, outside, farthest }: TransferredFields,
  isConservative: boolean,
): string[] {
  const change = ({ before, after }: { readonly before: number; readonly after: number }) =>
    before === 0 ? Math.abs(after) : Math.abs(after / before - 1);
  const changes = fields.map(
    ({ name = "" }, f) => `"${name}" ${short(Math.max(...(integrals[f] ?? []).map(change)), 2)}`,
  );
  return [
    ...(outside === 0
      ? []
      : [`${plural(outside, "node")} outside by up to ${short(farthest, 3)} took the nearest value`]),
    ...(isConservative ? [`relative change of the integral: ${changes.join(", ")}`] : []),
  ];
}
