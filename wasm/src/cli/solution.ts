/** `tetrafront sizes` and `tetrafront transfer`: a background grid from a solution, and a solution on another mesh. */
import path from "node:path";
import { decidingNames } from "../api/adaptation-cycles.js";
import { checkGradation, growthOf } from "../api/mesh-options.js";
import type { SolutionSizeOptions } from "../api/option-types.js";
import { checkSolutionSizeOptions } from "../api/solution-options.js";
import { plural } from "../base/plural.js";
import { short } from "../base/short.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { listed } from "../formats/groups.js";
import { readSol } from "../formats/medit-sol.js";
import { ReadFailure } from "../formats/read-result.js";
import { ERROR_NORMS, type ErrorNorm } from "../generated/constants.js";
import { dataOf, fieldsOf } from "../mesh/mesh-fields.js";
import type { Mesh } from "../mesh/mesh.js";
import type { FieldValues, SolutionSizes, TransferredFields } from "../mesh/solution.js";
import { writableName, writeMeshTo } from "./convert.js";
import { piecesOfInput, refuseFolder } from "./files.js";
import { type InputOptions, numberIn, readMeshFile, refuseOptions } from "./input.js";
import { ExitCode, InvalidInput, print, printDiagnostics, reportFailure, unreadable } from "./messages.js";
import { checkNoOverwrite, checkWritable, inputFiles, outputFiles } from "./paths.js";
import { withRun } from "./run.js";

/** Options as commander passes them. */
interface FieldCommandOptions extends InputOptions {
  readonly output: string;
  readonly to?: string;
  readonly field?: readonly string[];
  readonly quiet?: boolean;
}

/** Options of the sizes that follow from a solution. */
export interface SolutionSizeCommandOptions {
  readonly elements?: string;
  readonly error?: string;
  readonly norm?: string;
  readonly isotropic?: boolean;
  readonly minSize?: string;
  readonly maxSize?: string;
  readonly maxAspect?: string;
  readonly gradation?: string;
  readonly indicator?: string;
  readonly indicatorOrder?: string;
}

export interface SizesCommandOptions extends FieldCommandOptions, SolutionSizeCommandOptions {}

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
    const { field: names, indicator } = options;
    const named = indicator === undefined ? names : decidingNames([], { fields: names, indicator });
    const fields = fieldsFor(input, mesh, named);
    const made = await withRun(isQuiet, (mesher, controlOf) =>
      mesher.sizeFromSolution(mesh, fields, chosen, controlOf("solution")),
    );
    const { output } = options;
    await writeMeshTo({ input, output, name, isQuiet }, made.mesh);
    printDiagnostics(input, made.diagnostics, { isQuiet });
    if (!isQuiet) print(`${input}: ${sizesText(made, fields, indicator)} -> ${output}`);
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
    const fields = fieldsFor(input, from, options.field);
    const made = await withRun(isQuiet, (mesher, controlOf) =>
      mesher.transferSolution(from, to, fields, { conservative }, controlOf("solution")),
    );
    const { nodeData, elementData } = dataOf([...fieldsOf(to), ...made.fields]);
    await writeMeshTo({ input, output, name, isQuiet }, { ...to, nodeData, elementData });
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
export function sizeOptions(options: SolutionSizeCommandOptions): SolutionSizeOptions {
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
    indicator: options.indicator,
    indicatorOrder: numberIn(options.indicatorOrder),
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

/** Reads a volume mesh. Throws an InvalidInput if it has no tetrahedra. */
export async function readElements(input: string, options: InputOptions): Promise<Mesh> {
  const mesh = await readMeshFile(input, options);
  if (mesh.tetrahedra.length > 0) return mesh;
  const remedy = "Use the volume mesh on which the solution was computed.";
  throw new InvalidInput(input, [
    packageDiagnostic("no-tetrahedra", "the file contains no tetrahedra", remedy),
  ]);
}

/** Names of a single field of a Medit file that states none. */
const UNNAMED = ["size", "vector", "metric"];

/** Reads the values at nodes of a file without a mesh, by name. */
export async function readSolFile(file: string, nodes: number): Promise<Mesh["nodeData"]> {
  const name = path.basename(file);
  const read = await readSol(piecesOfInput(file), { fileName: name, nodes }).catch((failure: unknown) => {
    throw failure instanceof ReadFailure
      ? new InvalidInput(file, [unreadable(failure.error, name)])
      : failure;
  });
  const [note] = read.notes;
  if (note === undefined) {
    const [only] = read.nodeData;
    const isUnnamed = read.nodeData.size === 1 && only !== undefined && UNNAMED.includes(only[0]);
    return isUnnamed ? new Map([["solution", only[1]]]) : read.nodeData;
  }
  const remedy = "Write the values of all nodes of the mesh, in their order.";
  throw new InvalidInput(file, [packageDiagnostic("unreadable-input", note, remedy)]);
}

/**
 * Returns the fields with the given names, by default all at the nodes, and those of elements if there are none. Throws an
 * InvalidInput about a name that the file does not have.
 */
export function fieldsFor(
  input: string,
  mesh: Pick<Mesh, "nodeData" | "elementData">,
  names: readonly string[] | undefined,
): FieldValues[] {
  const all = fieldsOf(mesh);
  const atNodes = all.filter(({ isPerElement = false }) => !isPerElement);
  if (all.length === 0) {
    const remedy =
      "Write the fields of the solver as values at the nodes (VTU: PointData) or of the elements.";
    throw new InvalidInput(input, [packageDiagnostic("unreadable-input", "no field in the file", remedy)]);
  }
  if (names === undefined) return atNodes.length > 0 ? atNodes : all;
  const known = [...new Set(all.map(({ name }) => `"${name}"`))];
  return names.map((name) => {
    const field = all.find((one) => one.name === name);
    if (field !== undefined) return field;
    const message = `there is no field "${name}"`;
    const remedy = `The file has ${listed(known)}.`;
    throw new InvalidInput(input, [packageDiagnostic("unreadable-input", message, remedy)]);
  });
}

function sizesText(
  { elements, expectedErrors, metrics }: SolutionSizes,
  fields: readonly FieldValues[],
  indicator: string | undefined,
): string {
  const parts = expectedErrors.map((error, f) => {
    const name = fields[f]?.name ?? "";
    return `${name === indicator ? "largest" : "error of"} "${name}" ${short(error, 3)}`;
  });
  return `a metric at ${plural(metrics.length / 6, "node")} for about ${short(elements, 4)} elements; expected ${parts.join(", ")}`;
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
