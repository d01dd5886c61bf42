/** `tetrafront check`: everything that is wrong with a project, a surface or a mesh, without meshing it. */
import { writeToStandardOutput } from "./files.js";
import { withMesher } from "./grids.js";
import { isProject, numberIn, readMeshFile, readProjectFile, refuseOptions } from "./input.js";
import { LIMITS } from "../base/limits.js";
import {
  asBadInput,
  asEngineFailure,
  BadInput,
  countOf,
  ExitCode,
  jsonPieces,
  say,
  tell,
} from "./messages.js";
import { refuseRepair, repaired, repairOptions, tellChanges, type RepairCommandOptions } from "./repair.js";
import { meshLines, otherWay, readingLines, surfaceLines } from "./tables.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { FileMesh } from "../formats/file-mesh.js";
import { listed } from "../formats/groups.js";
import { inSteps } from "../formats/steps.js";
import { surfaceOf } from "../formats/surface-file.js";
import type { MeshInspection, RepairChange, SurfaceInspection } from "../api/inspection.js";
import { checkInspectionOptions, checkPreviewOptions } from "../api/options.js";
import { plural } from "../base/plural.js";
import type { Diagnostic, Mesher } from "../api/types.js";

export interface CheckCommandOptions extends RepairCommandOptions {
  readonly size?: string;
  /** A number, or `all`. */
  readonly findings?: string;
  readonly from?: string;
  readonly json?: boolean;
  readonly quiet?: boolean;
}

/** What was found, as `--json` has it. */
type Findings =
  | { readonly kind: "project"; readonly diagnostics: readonly Diagnostic[] }
  | {
      readonly kind: "surface";
      readonly diagnostics: readonly Diagnostic[];
      readonly changes?: readonly RepairChange[] | undefined;
      readonly inspection: Omit<SurfaceInspection, "diagnostics">;
    }
  | {
      readonly kind: "mesh";
      readonly diagnostics: readonly Diagnostic[];
      readonly inspection: Omit<MeshInspection, "boundary" | "quality">;
    }
  /** It could not even be read. */
  | {
      readonly kind: "none";
      readonly diagnostics: readonly Diagnostic[];
      readonly subject: string;
      /** Not the input failed, but the engine. */ readonly isEngine?: true;
    };

/** In lines of text, unless `--findings` asks for more or fewer. */
const TOLD_PER_CODE = 50;

/** Runs the command; resolves with the exit code. */
export async function checkFile(input: string, options: CheckCommandOptions): Promise<number> {
  const findings = await found(input, options);
  const { diagnostics } = findings;
  const errors = countOf(diagnostics, "error");
  const isQuiet = options.quiet === true;
  if (options.json === true) {
    const { subject: _, isEngine: __, ...told } = { subject: "", isEngine: false, ...findings };
    for (const piece of jsonPieces({ input, errors, ...told })) await writeToStandardOutput(piece);
  } else {
    if (!isQuiet) tellFigures(input, findings);
    const subject = findings.kind === "none" ? findings.subject : input;
    const asked = findings.kind === "surface" ? findingsAsked(options) : undefined;
    tell(subject, diagnostics, { isQuiet, perCode: asked ?? TOLD_PER_CODE });
    if (!isQuiet) say(`${input}: ${counted(diagnostics)}`);
  }
  if (findings.kind === "none" && findings.isEngine === true) return ExitCode.notCompleted;
  return errors > 0 ? ExitCode.badInput : ExitCode.meshed;
}

function tellFigures(input: string, findings: Findings): void {
  if (findings.kind === "surface") {
    if (findings.changes !== undefined) tellChanges(input, findings.changes);
    for (const line of surfaceLines(findings.inspection)) say(`${input}: ${line}`);
  }
  if (findings.kind === "mesh") for (const line of meshLines(findings.inspection)) say(`${input}: ${line}`);
}

/** Of each code so many; undefined where nothing is said of it. What is no number is left for the check of options. */
function findingsAsked({ findings }: CheckCommandOptions): number | undefined {
  return findings === "all" ? LIMITS.maxDiagnostics : numberIn(findings);
}

async function found(input: string, options: CheckCommandOptions): Promise<Findings> {
  try {
    const size = numberIn(options.size);
    const { enclosed } = options;
    refuseOptions([
      ...checkPreviewOptions({ size, innerShells: enclosed }),
      ...checkInspectionOptions({ maxDiagnostics: findingsAsked(options) }),
    ]);
    if (isProject(input, options.from)) {
      refuseOption("--findings", options.findings, "surfaces", "a project");
      refuseRepair(repairOptions(options), "a project");
      const project = await readProjectFile(input, options.from);
      const { diagnostics } = await withMesher((mesher) =>
        mesher.previewProject(project, { size, innerShells: enclosed }),
      );
      return { kind: "project", diagnostics };
    }
    return await withMesher((mesher) => inspected(mesher, input, options));
  } catch (failure) {
    const engine = asEngineFailure(failure);
    if (engine !== undefined) return { kind: "none", diagnostics: [engine], subject: input, isEngine: true };
    const bad = asBadInput(failure, input);
    if (bad === undefined) throw failure;
    return { kind: "none", diagnostics: bad.diagnostics, subject: bad.subject };
  }
}

async function inspected(mesher: Mesher, input: string, options: CheckCommandOptions): Promise<Findings> {
  const wanted = repairOptions(options);
  const mesh = await readMeshFile(input, options.from);
  refuseOption("--size", options.size, "projects", mesh.tetrahedra.length > 0 ? "a mesh" : "a surface");
  if (mesh.tetrahedra.length > 0) {
    refuseRepair(wanted, "a mesh of tetrahedra");
    refuseOption("--enclosed", options.enclosed, "surfaces and projects", "a mesh of tetrahedra");
    refuseOption("--findings", options.findings, "surfaces", "a mesh of tetrahedra");
    const {
      boundary: _,
      quality: __,
      ...inspection
    } = await mesher.inspectMesh({
      ...mesh,
      regions: mesh.tetrahedronRegion,
    });
    return { kind: "mesh", diagnostics: [...faultsOf(inspection, mesh), ...notes(mesh)], inspection };
  }
  if (mesh.triangles.length === 0) {
    const nothing = packageDiagnostic("no-triangles", "the file holds no triangle and no tetrahedron", "");
    throw new BadInput(input, [nothing]);
  }
  const { surface, changes } = await repaired(mesher, await inSteps(surfaceOf(mesh)), wanted);
  const judged = { innerShells: options.enclosed, maxDiagnostics: findingsAsked(options) };
  const { diagnostics, ...inspection } = await mesher.inspectSurface(surface, judged);
  return { kind: "surface", diagnostics: [...diagnostics, ...notes(mesh)], changes, inspection };
}

/** What is no fault of the file, but should be known. */
function notes(mesh: FileMesh): Diagnostic[] {
  return [...otherWay(mesh), ...readingLines(mesh)].map((line) =>
    packageDiagnostic("left-out", line, "", "information"),
  );
}

/** Throws a BadInput where an option is given that says nothing of such input. */
function refuseOption(option: string, value: string | undefined, meantFor: string, what: string): void {
  if (value === undefined) return;
  const message = `${option} is for ${meantFor}, and this is ${what}`;
  refuseOptions([invalidOption(option, message, "Leave it out.")]);
}

const NONE = new Uint32Array();

/** What is unsound in a mesh, in sentences. */
function faultsOf(
  found: Omit<MeshInspection, "boundary" | "quality">,
  { invertedTetrahedra = NONE }: FileMesh,
): Diagnostic[] {
  // The reader, which has turned them, knows which; of others only their number is known.
  const isKnown = invertedTetrahedra.length === found.invertedTetrahedra;
  const which = isKnown ? `: ${listed(Array.from(invertedTetrahedra, String))} (counted from 0)` : "";

  const faults: readonly (readonly [number, string, string, string])[] = [
    [found.invertedTetrahedra, "tetrahedron", `turned inside out${which}`, "Exchange two nodes of each."],
    [found.degenerateTetrahedra, "tetrahedron", "without volume", "Mesh the body again."],
    [found.duplicateTetrahedra, "tetrahedron", "with the nodes of another", "Remove all but one."],
    [found.nonManifoldFaces, "face", "of more than two tetrahedra", "Mesh the body again."],
    [found.overlappingFaces, "face", "with both tetrahedra on one side", "Mesh the body again."],
    [found.coincidentNodes, "node", "at the place of another", "Weld what lies at one place."],
  ];
  return faults
    .filter(([count]) => count > 0)
    .map(([count, noun, words, remedy]) =>
      packageDiagnostic("unsound-mesh", `${plural(count, noun)} ${words}`, remedy),
    );
}

/** "2 errors, 1 warning", or "no problems". */
function counted(diagnostics: readonly Diagnostic[]): string {
  const parts = (["error", "warning"] as const).flatMap((severity) => {
    const count = countOf(diagnostics, severity);
    return count === 0 ? [] : [plural(count, severity)];
  });
  return parts.length === 0 ? "no problems" : parts.join(", ");
}
