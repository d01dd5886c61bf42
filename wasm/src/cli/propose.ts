/** `tetrafront propose`: writes sizes into a project, or prints the sizes of a surface. */
import type { SurfaceSizeProposal } from "../api/mesher-interface.js";
import type { SurfaceProposalOptions } from "../api/option-types.js";
import { checkSurfaceProposalOptions } from "../api/surface-options.js";
import { located } from "../api/located-surface.js";
import { madeFillable } from "../api/surface-preparation.js";
import { plural } from "../base/plural.js";
import { short } from "../base/short.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { writeToStandardOutput } from "./files.js";
import { proposalOptions, type ProposeCommandOptions, proposeForFile, withMesher } from "./grids.js";
import { isProject, readModel, refuseOptions } from "./input.js";
import { ExitCode, printDiagnostics, reportFailure } from "./messages.js";
import { printChanges } from "./repair.js";
import { refuseUnits, type UnitOptions } from "./units.js";

export interface ProposeOptions extends Omit<ProposeCommandOptions, "output">, UnitOptions {
  readonly output?: string;
  readonly from?: string | undefined;
  readonly json?: boolean;
}

/** Runs the command; resolves with the exit code. */
export async function propose(input: string, options: ProposeOptions): Promise<number> {
  try {
    if (!isProject(input, options.from)) return await proposeForSurface(input, options);
    const { output } = options;
    refuseUnits(options);
    if (options.json === true) {
      refuseOptions([
        invalidOption("--json", "--json is for surfaces, but the input is a project", "Omit it."),
      ]);
    }
    if (output !== undefined) return await proposeForFile(input, { ...options, output });
    const message = "the input is a project, but there is no output file";
    refuseOptions([invalidOption("--output", message, "Add -o with the name of a project.")]);
  } catch (failure) {
    return reportFailure(failure, input);
  }
  return ExitCode.invalidInput;
}

async function proposeForSurface(input: string, options: ProposeOptions): Promise<number> {
  if (options.output !== undefined || options.shape !== undefined) {
    const option = options.output === undefined ? "--shape" : "--output";
    const message = `${option} is for projects, but the input is a surface, whose sizes are printed`;
    refuseOptions([invalidOption(option, message, "Omit it; `tetrafront remesh` uses these sizes.")]);
  }
  const sizes: SurfaceProposalOptions = proposalOptions(options);
  refuseOptions(checkSurfaceProposalOptions(sizes));
  const given = await readModel(input, options);
  if (given.kind === "project") return ExitCode.invalidInput;
  const { surface, proposal } = await withMesher(async (mesher) => {
    const isQuiet = options.quiet === true || options.json === true;
    const made = await madeFillable(mesher, given.surface, {
      innerShells: undefined,
      isRemeshed: true,
    });
    const { surface: whole, warnings = [] } = made;
    if (!isQuiet) printChanges(input, made);
    const found = await located(mesher, whole);
    printDiagnostics(input, [...warnings, ...found.diagnostics], { isQuiet: options.quiet === true });
    return { surface: found.surface, proposal: await mesher.proposeSurfaceSizes(found.surface, sizes) };
  });
  const { unit } = surface;
  const text =
    options.json === true
      ? JSON.stringify({ input, unit: unit ?? null, ...proposal }, null, 2)
      : proposalText(input, proposal, unit === undefined ? "" : ` ${unit}`);
  await writeToStandardOutput(`${text}\n`);
  return ExitCode.meshed;
}

function proposalText(input: string, proposal: SurfaceSizeProposal, unit: string): string {
  const { size, minSize, tolerance, triangles, tetrahedra } = proposal;
  return [
    input,
    `sizes ${short(minSize)} to ${short(size)}${unit}, tolerance ${short(tolerance)}${unit}`,
    `about ${plural(rounded(triangles), "triangle")} and ${plural(rounded(tetrahedra), "tetrahedron")}`,
  ].join("\n  ");
}

/** Rounds an estimate to two digits. */
const rounded = (count: number) => Number(count.toPrecision(2));
