/** `tetrafront check`: lists all problems of a project, a surface or a mesh, without meshing it. */
import { readingNotes } from "../api/reading-notes.js";
import { ofBody } from "../api/body-preparation.js";
import type { Mesher } from "../api/mesher-interface.js";
import type { PreviewOptions } from "../api/option-types.js";
import { withoutRegions } from "../api/stated-solids.js";
import { readySurface } from "../api/surface-meshing.js";
import { checkPreviewOptions } from "../api/mesh-options.js";
import { checkInspectionOptions } from "../api/surface-options.js";
import { LIMITS } from "../base/limits.js";
import { plural } from "../base/plural.js";
import { inSteps } from "../calls/yielder.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { countOf } from "../diagnostics/lines.js";
import { MesherError } from "../diagnostics/mesher-error.js";
import { invalidOption, packageDiagnostic, printable } from "../diagnostics/package-diagnostic.js";
import { listed } from "../formats/groups.js";
import { surfaceOf } from "../formats/surface-file.js";
import type { Mesh } from "../mesh/mesh.js";
import type { MeshInspection, RepairChange, SurfaceInspection } from "../mesh/inspection.js";
import { poorElementWarnings } from "../mesh/quality-warnings.js";
import { bodySurface } from "../project/bodies.js";
import type { Project } from "../project/project-types.js";
import { writeToStandardOutput } from "./files.js";
import { withMesher } from "./grids.js";
import {
  isCadInput,
  isProject,
  numberIn,
  readMeshFile,
  readProjectFile,
  refuseOptions,
  surfaceIn,
} from "./input.js";
import { readGiven, subjectOf } from "./joined-inputs.js";
import {
  asInvalidInput,
  asEngineFailure,
  InvalidInput,
  ExitCode,
  jsonPieces,
  print,
  printDiagnostics,
} from "./messages.js";
import { printChanges, refuseRepair, type RepairCommandOptions, repairOptions } from "./repair.js";
import type { UnitOptions } from "./units.js";
import { meshLines, oppositeOrderLines, surfaceLines } from "./tables.js";

export interface CheckCommandOptions extends RepairCommandOptions, UnitOptions {
  readonly size?: string;
  /** Number or `all`. */
  readonly maxDiagnostics?: string;
  readonly from?: string;
  /** All inputs, if they are joined. */
  readonly joined?: readonly string[];
  readonly json?: boolean;
  readonly quiet?: boolean;
}

/** Result of a check, as printed by `--json`. */
type CheckResult =
  | { readonly kind: "project"; readonly diagnostics: readonly Diagnostic[] }
  | {
      readonly kind: "surface";
      readonly diagnostics: readonly Diagnostic[];
      readonly changes?: readonly RepairChange[] | undefined;
      readonly repairDeviation?: number | undefined;
      readonly inspection: Omit<SurfaceInspection, "diagnostics">;
    }
  | {
      readonly kind: "mesh";
      readonly diagnostics: readonly Diagnostic[];
      readonly inspection: Omit<MeshInspection, "boundary" | "quality">;
    }
  /** The input could not be read. */
  | {
      readonly kind: "none";
      readonly diagnostics: readonly Diagnostic[];
      readonly subject: string;
      /** The engine failed, not the input. */ readonly isEngine?: true;
    };

/** Runs the command; resolves with the exit code. */
export async function checkFile(input: string, options: CheckCommandOptions): Promise<number> {
  const result = await checked(input, options);
  const { diagnostics } = result;
  const named = subjectOf(input, options.joined);
  const errors = countOf(diagnostics, "error");
  const isQuiet = options.quiet === true;
  if (options.json === true) {
    const { subject: _, isEngine: __, ...printed } = { subject: "", isEngine: false, ...result };
    const inputs = options.joined === undefined ? {} : { inputs: options.joined };
    for (const piece of jsonPieces({ input, ...inputs, errors, ...printed }))
      await writeToStandardOutput(piece);
  } else {
    const lines: string[] = [];
    const onLine = (line: string) => void lines.push(printable(line));
    if (!isQuiet) addStatistics(named, result, onLine);
    const subject = result.kind === "none" ? result.subject : named;
    const perCode = result.kind === "surface" ? maxDiagnosticsOf(options) : undefined;
    printDiagnostics(subject, diagnostics, { isQuiet, perCode, onLine });
    if (!isQuiet) onLine(`${named}: ${counted(diagnostics)}`);
    await printResult(result, lines);
  }
  if (result.kind === "none" && result.isEngine === true) return ExitCode.notCompleted;
  return errors > 0 ? ExitCode.invalidInput : ExitCode.meshed;
}

/** Prints the result to standard output; to standard error that an input could not be checked. */
async function printResult({ kind }: CheckResult, lines: readonly string[]): Promise<void> {
  if (kind === "none") for (const line of lines) print(line);
  else if (lines.length > 0) await writeToStandardOutput(`${lines.join("\n")}\n`);
}

function addStatistics(input: string, result: CheckResult, onLine: (line: string) => void): void {
  if (result.kind === "surface") {
    printChanges(input, result, onLine);
    for (const line of surfaceLines(result.inspection)) onLine(`${input}: ${line}`);
  }
  if (result.kind === "mesh") for (const line of meshLines(result.inspection)) onLine(`${input}: ${line}`);
}

/**
 * Returns the value of `--max-diagnostics`; undefined if it is not given. The check of options rejects text that
 * is not a number.
 */
function maxDiagnosticsOf({ maxDiagnostics }: CheckCommandOptions): number | undefined {
  return maxDiagnostics === "all" ? LIMITS.maxDiagnostics : numberIn(maxDiagnostics);
}

/** Checks what is drawn, and the triangles of each body by themselves. */
async function checkedProject(
  mesher: Mesher,
  project: Project,
  options: PreviewOptions,
): Promise<CheckResult> {
  const { diagnostics } = await mesher.previewProject(project, options);
  const ofBodies: Diagnostic[] = [];
  const innerShells = options.innerShells ?? project.meshing?.innerShells;
  for (const body of project.bodies ?? []) {
    const surface = bodySurface(body);
    const found = await mesher.inspectSurface(surface, { innerShells });
    // A surface is remeshed because of its needles.
    const problems = found.diagnostics.filter(({ severity }) => severity === "error");
    ofBodies.push(...problems.map((problem) => ofBody(problem, body, surface.trianglePatch)));
  }
  return { kind: "project", diagnostics: [...diagnostics, ...ofBodies] };
}

async function checked(input: string, options: CheckCommandOptions): Promise<CheckResult> {
  try {
    const size = numberIn(options.size);
    const { innerShells } = options;
    refuseOptions([
      ...checkPreviewOptions({ size, innerShells }),
      ...checkInspectionOptions({ maxDiagnostics: maxDiagnosticsOf(options) }),
    ]);
    if (isProject(input, options.from) && options.joined === undefined) {
      refuseOption("--max-diagnostics", options.maxDiagnostics, "surfaces", "a project");
      refuseRepair(repairOptions(options), "a project");
      const project = await readProjectFile(input, options.from);
      return await withMesher((mesher) => checkedProject(mesher, project, { size, innerShells }));
    }
    return await withMesher((mesher) =>
      options.joined === undefined
        ? inspected(mesher, input, options)
        : inspectedTogether(mesher, input, options),
    );
  } catch (failure) {
    const engine = asEngineFailure(failure);
    if (engine !== undefined) return { kind: "none", diagnostics: [engine], subject: input, isEngine: true };
    const invalid = asInvalidInput(failure, input);
    if (invalid === undefined) throw failure;
    return { kind: "none", diagnostics: invalid.diagnostics, subject: invalid.subject };
  }
}

async function inspected(mesher: Mesher, input: string, options: CheckCommandOptions): Promise<CheckResult> {
  const repair = repairOptions(options);
  const mesh = await readMeshFile(input, options);
  refuseOption("--size", options.size, "projects", mesh.tetrahedra.length > 0 ? "a mesh" : "a surface");
  if (mesh.tetrahedra.length > 0) {
    refuseRepair(repair, "a mesh of tetrahedra");
    refuseOption("--inner-shells", options.innerShells, "surfaces and projects", "a mesh of tetrahedra");
    refuseOption("--max-diagnostics", options.maxDiagnostics, "surfaces", "a mesh of tetrahedra");
    const { boundary: _, quality, ...inspection } = await mesher.inspectMesh(mesh);
    const defects = defectsOf(inspection, mesh);
    return {
      kind: "mesh",
      diagnostics: [...defects, ...poorElementWarnings(quality, true), ...notes(mesh)],
      inspection,
    };
  }
  if (mesh.triangles.length === 0) {
    const nothing = packageDiagnostic(
      "no-triangles",
      "the file contains no triangles and no tetrahedra",
      "Use a file with a surface or a volume mesh.",
    );
    throw new InvalidInput(input, [nothing]);
  }
  const given = await inSteps(surfaceOf(mesh));
  return inspectedSurface(mesher, given, {
    options,
    isCad: isCadInput(input, options.from),
    notes: notes({ ...mesh, notes: given.notes }),
  });
}

/** Checks the surfaces of several files as one, as `tetrafront mesh --join` meshes them. */
async function inspectedTogether(
  mesher: Mesher,
  input: string,
  options: CheckCommandOptions,
): Promise<CheckResult> {
  repairOptions(options);
  refuseOption("--size", options.size, "projects", "several surfaces");
  const { given, diagnostics } = await readGiven(input, options, undefined);
  const isCad = (options.joined ?? [input]).some((file) => isCadInput(file, options.from));
  return inspectedSurface(mesher, surfaceIn(given), { options, isCad, notes: diagnostics });
}

interface SurfaceCheck {
  readonly options: CheckCommandOptions;
  /** Whether the surface was triangulated from shapes. */
  readonly isCad: boolean;
  readonly notes: readonly Diagnostic[];
}

/** Checks the surface that `mesh` would treat and fill. If `mesh` refuses it, says why, and describes it as it is. */
async function inspectedSurface(
  mesher: Mesher,
  given: Mesh,
  { options, isCad, notes: others }: SurfaceCheck,
): Promise<CheckResult> {
  const { repair, weld, fillHoles, innerShells } = options;
  const settings = { repair, weld: numberIn(weld), fillHoles: numberIn(fillHoles), innerShells };
  const ready = await readySurface(mesher, given, settings, { isCad }).catch(refusal);
  const surface = "refused" in ready ? withoutRegions(given) : ready.surface;
  const { diagnostics, ...inspection } = await mesher.inspectSurface(surface, {
    innerShells: innerShells ?? (given.regionPoints && "regions"),
    maxDiagnostics: maxDiagnosticsOf(options),
  });
  const result = { kind: "surface", inspection } as const;
  if ("refused" in ready) {
    const { refused } = ready;
    // The inspection lists as many as are asked for.
    const isListed = ({ code }: Diagnostic) => diagnostics.some((found) => found.code === code);
    const more = refused.filter((found) => !isListed(found));
    return { ...result, diagnostics: [...diagnostics, ...more, ...others] };
  }
  const { changes, repairDeviation } = ready;
  // An implied repair has welded nodes that nearly coincide.
  const isChanged = changes !== undefined && changes.length > 0 && repair !== true;
  const before = isChanged ? await mesher.inspectSurface(withoutRegions(given)) : undefined;
  const isReplaced = ready.treatment.kind === "remesh";
  const shown = isReplaced ? diagnostics.flatMap((found) => withoutAdvice(found, isCad)) : diagnostics;
  const hasWelded = changes?.some(({ kind }) => kind === "welded-node") ?? false;
  const near = before?.diagnostics.flatMap((found) => (hasWelded ? asWelded(found) : [])) ?? [];
  return {
    ...result,
    diagnostics: [...ready.diagnostics, ...near, ...shown, ...others],
    changes,
    repairDeviation,
  };
}

/** Makes a warning about nodes that nearly coincide a note: a repair has welded them. Leaves out others. */
function asWelded(found: Diagnostic): Diagnostic[] {
  if (found.code !== "near-nodes") return [];
  const remedy = `The repair welded such nodes. To weld no others, use \`weld: ${found.data.distance}\`, which suffices.`;
  return [{ ...found, severity: "information", remedy }];
}

/** Makes the warning about needles a note: a mesh replaces them. Triangles of CAD programs are always replaced: nothing is said. */
function withoutAdvice(found: Diagnostic, isCad: boolean): Diagnostic[] {
  if (found.code !== "needle-surface") return [found];
  const remedy = 'A mesh replaces all triangles, as by `surface: "remesh"`.';
  return isCad ? [] : [{ ...found, severity: "information", remedy }];
}

/** Returns why the input is refused; rethrows other failures. */
function refusal(failure: unknown): { readonly refused: readonly Diagnostic[] } {
  if (failure instanceof MesherError && failure.code === "invalid-input")
    return { refused: failure.data.diagnostics };
  throw failure;
}

/** Notes about the file that are not problems. */
function notes(mesh: Mesh): Diagnostic[] {
  return [...oppositeOrderLines(mesh), ...readingNotes(mesh)].map((line) =>
    packageDiagnostic("left-out", line, "", "information"),
  );
}

/** Throws an InvalidInput if an option is given that does not apply to the input. */
function refuseOption(option: string, value: string | undefined, meantFor: string, what: string): void {
  if (value === undefined) return;
  const message = `${option} is for ${meantFor}, but the input is ${what}`;
  refuseOptions([invalidOption(option, message, `Omit ${option}.`)]);
}

const NONE = new Uint32Array();

/** Describes the defects of a mesh. */
function defectsOf(
  found: Omit<MeshInspection, "boundary" | "quality">,
  { invertedTetrahedra = NONE }: Mesh,
): Diagnostic[] {
  // The reader knows which tetrahedra are inverted if it reversed their nodes; otherwise only their number is
  // known.
  const isKnown = invertedTetrahedra.length === found.invertedTetrahedra;
  const which = isKnown ? `: ${listed(Array.from(invertedTetrahedra, String))} (counted from 0)` : "";

  const defects: readonly (readonly [number, string, string, string])[] = [
    [
      found.invertedTetrahedra,
      "tetrahedron",
      `with negative volume (inverted)${which}`,
      "Swap two nodes of each.",
    ],
    [found.degenerateTetrahedra, "tetrahedron", "without volume (degenerate)", "Mesh the region again."],
    [
      found.duplicateTetrahedra,
      "tetrahedron",
      "with the same nodes as another (duplicate)",
      "Remove all but one.",
    ],
    [
      found.nonManifoldFaces,
      "face",
      "with more than two tetrahedra (non-manifold)",
      "Mesh the region again.",
    ],
    [
      found.overlappingFaces,
      "face",
      "with both tetrahedra on the same side (overlapping)",
      "Mesh the region again.",
    ],
    [
      found.coincidentNodes,
      "node",
      "with the same position as another (coincident)",
      "Weld nodes with the same position.",
    ],
  ];
  return defects
    .filter(([count]) => count > 0)
    .map(([count, noun, words, remedy]) =>
      packageDiagnostic("invalid-mesh", `${plural(count, noun)} ${words}`, remedy),
    );
}

/** Summarizes diagnostics: "2 errors, 1 warning", or "no problems". */
function counted(diagnostics: readonly Diagnostic[]): string {
  const parts = (["error", "warning"] as const).flatMap((severity) => {
    const count = countOf(diagnostics, severity);
    return count === 0 ? [] : [plural(count, severity)];
  });
  return parts.length === 0 ? "no problems" : parts.join(", ");
}
