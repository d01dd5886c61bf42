/** Reads the inputs of `--join`. */
import path from "node:path";
import { located, type Located } from "../api/located-surface.js";
import { inSteps } from "../calls/yielder.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { assemblyOf, type AssemblyPart } from "../formats/assembly.js";
import { surfaceOf } from "../formats/surface-file.js";
import type { InnerShells } from "../generated/constants.js";
import { withMesher } from "./grids.js";
import { type Input, type InputOptions, readModel } from "./input.js";
import { asInvalidInput, InvalidInput } from "./messages.js";
import type { Mesh } from "../mesh/mesh.js";

interface GivenOptions extends InputOptions {
  /** All inputs, if they are joined to one model. */
  readonly joined?: readonly string[] | undefined;
  readonly innerShells?: InnerShells | undefined;
}

/** Number of files whose names a message lists. */
const MAX_NAMES = 3;

/** Returns the subject of messages: the input, or all inputs that are joined. */
export function subjectOf(input: string, joined: readonly string[] = []): string {
  if (joined.length < 2) return input;
  const more = joined.length - MAX_NAMES;
  return [...joined.slice(0, MAX_NAMES), ...(more > 0 ? [`${more} more`] : [])].join(" + ");
}

/**
 * Reads the input, or all inputs that are joined, with warnings about region points of the latter. `size`: target edge
 * length, if it is given.
 */
export async function readGiven(
  input: string,
  { joined = [], ...options }: GivenOptions,
  size: number | undefined,
): Promise<{ readonly given: Input; readonly diagnostics: readonly Diagnostic[] }> {
  if (joined.length < 2) return { given: await readModel(input, options, size), diagnostics: [] };
  const { surface, diagnostics } = await readJoined(joined, options, size);
  return { given: { kind: "surface", surface }, diagnostics };
}

/**
 * Reads several surfaces as one: their solids are its regions, and faces that two solids share are interfaces. Points that
 * mark regions and holes count in their own file only.
 */
async function readJoined(
  files: readonly string[],
  { innerShells, ...options }: GivenOptions,
  size: number | undefined,
): Promise<Located> {
  const parts: AssemblyPart[] = [];
  const diagnostics: Diagnostic[] = [];
  for (const file of files) {
    const read = await readModel(file, options, size);
    if (read.kind === "project") throw new InvalidInput(file, [projectJoined]);
    const { unit } = parts[0]?.surface ?? read.surface;
    if (read.surface.unit !== unit) throw new InvalidInput(file, [otherUnit(unit, read.surface.unit)]);
    const part = await locatedPart(file, read.surface, innerShells);
    parts.push({ name: path.parse(file).name, surface: part.surface });
    diagnostics.push(...part.diagnostics);
  }
  return { surface: await inSteps(surfaceOf(await inSteps(assemblyOf(parts)))), diagnostics };
}

async function locatedPart(file: string, surface: Mesh, innerShells?: InnerShells): Promise<Located> {
  if (surface.regionPoints === undefined) return { surface, diagnostics: [] };
  try {
    return await withMesher((mesher) => located(mesher, surface, innerShells));
  } catch (failure) {
    throw asInvalidInput(failure, file) ?? failure;
  }
}

const projectJoined = packageDiagnostic(
  "unreadable-input",
  "the input is a project, but only surfaces can be joined",
  "Omit --join, or join the surfaces of which the project was made.",
);

function otherUnit(first: string | undefined, unit: string | undefined): Diagnostic {
  const words = [unit, first].map((one) => one ?? "unknown");
  const message = `the unit of the file is ${words[0]}, but that of the first file is ${words[1]}`;
  return packageDiagnostic(
    "unreadable-input",
    message,
    "Use --units, with --file-units for files without a unit.",
  );
}
