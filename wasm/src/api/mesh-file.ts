/** One call from a file to its mesh. */
import { asObject, shown } from "../base/values.js";
import { diagnosticLines } from "../diagnostics/lines.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { MesherError, refuse } from "../diagnostics/mesher-error.js";
import { invalidOption, readDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { ReadResult } from "../diagnostics/read-error.js";
import type { RunControl } from "../engine/control.js";
import { type ByteSource, piecesOf } from "../formats/byte-source.js";
import { joined } from "../formats/bytes.js";
import type { OpenOther } from "../formats/file-format.js";
import { extensionOf, isCadFile } from "../formats/file-formats.js";
import type { LengthOptions } from "../formats/units.js";
import type { Mesh } from "../mesh/mesh.js";
import type { RepairChange } from "../mesh/inspection.js";
import type { MeshReport, MeshResult, MeshStatus } from "../mesh/report.js";
import { readProject } from "../project/project.js";
import type { Project } from "../project/project-types.js";
import { checkControl } from "./input-checks.js";
import { type ReadFileOptions, readSurface } from "./mesh-files.js";
import type { Mesher } from "./mesher-interface.js";
import { createMesher } from "./mesher.js";
import type { SurfaceMeshOptions } from "./option-types.js";
import { checkOptions } from "./mesh-options.js";
import { readingNotes, unmeshedNotes } from "./reading-notes.js";
import { emptyReport } from "./report.js";
import { checkSurfaceMeshOptions, projectPart, surfaceOption } from "./surface-mesh-options.js";
import { meshedSurface as surfaceMeshed } from "./surface-meshing.js";
import type { RefinementCounts, RemeshReport } from "./meshed-surface.js";
import { refinementText, remeshText, repairText, splitText } from "./treatment-texts.js";

/** Options of `meshFile`. Lengths are in the unit of the file, or in the one to which it is converted. */
export interface MeshFileOptions extends SurfaceMeshOptions, LengthOptions {
  /** Name of the file, whose extension selects the format. Default: that of a `File`. */
  readonly fileName?: string | undefined;
  /** Opens the other files of a format with several, such as TetGen's `.node` next to a `.face`. */
  readonly openOther?: OpenOther | undefined;
  /** Mesher that makes the mesh; it is not disposed of. Default: one of its own, for many files slower. */
  readonly mesher?: Mesher | undefined;
}

/** Statistics of a mesh, and what was done to the surface before; the same as `tetrafront mesh --report` writes. */
export interface MeshFileReport extends MeshReport {
  /** Changes of the repair, if there was one. */
  readonly repair?: readonly RepairChange[] | undefined;
  /** Largest distance by which the repair moved a node, in model units. */
  readonly repairDeviation?: number | undefined;
  readonly refinement?: RefinementCounts | undefined;
  readonly remesh?: RemeshReport | undefined;
}

/** What `meshFile` reports, whether it succeeds or not. */
export interface MeshFileOutcome {
  readonly report: MeshFileReport;
  /** What was done to the surface, and what is worth to know: one sentence each, a few per kind. */
  readonly notes: readonly string[];
}

/** Result of `meshFile`. Expected failures are values. */
export type MeshedFile =
  | (MeshFileOutcome & {
      readonly success: true;
      /** The mesh with its patches and regions, ready for `writeMesh`. */
      readonly mesh: Mesh;
    })
  | (MeshFileOutcome & {
      readonly success: false;
      /** Why there is no mesh, and what to do, in a few sentences. All problems are in `report.diagnostics`. */
      readonly message: string;
      /** The mesh made so far, if the front stalled or was stopped. */
      readonly mesh: Mesh | undefined;
    });

/**
 * Reads a file and meshes it with fit elements: a surface, a CAD file or a project. Joins solids that touch, replaces the needles
 * of CAD programs, and repairs a surface before if that changes nothing visible; `notes` state what was done, and `surface`,
 * `repair`, `weld` and others decide otherwise. Rejects with a `MesherError` only if the control is invalid,
 * memory runs out, the mesher is disposed of, or the engine cannot be loaded or fails.
 *
 *     const made = await meshFile(file, { size: 0.5 });
 *     if (made.success) download(await writeMesh(made.mesh, "part.vtu"));
 *     else show(made.message);
 */
export async function meshFile(
  file: ByteSource,
  options: MeshFileOptions = {},
  control: RunControl = {},
): Promise<MeshedFile> {
  refuse(checkControl(control));
  try {
    return await readAndMeshed(file, options, control);
  } catch (failure) {
    if (failure instanceof MesherError && failure.code === "cancelled") return failed([], "cancelled");
    throw failure;
  }
}

async function readAndMeshed(
  file: ByteSource,
  options: MeshFileOptions,
  control: RunControl,
): Promise<MeshedFile> {
  if (typeof options !== "object" || (options as unknown) === null) return failed(checkOptions(options));
  const { fileName = nameOf(file), openOther, mesher, scale, units, fileUnits, ...meshing } = options;
  const wrong = [...checkSurfaceMeshOptions(meshing), ...checkMesher(mesher)];
  if (wrong.length > 0) return failed(wrong);
  const { signal } = control;
  if (typeof fileName === "string" && extensionOf(fileName) === PROJECT_EXTENSION) {
    const read = readProject(new TextDecoder().decode(await bytesOf(file, signal)));
    if (!read.success) return unopened(read);
    return withMesher(mesher, control, (made) => meshedProject(made, read.value, meshing, control));
  }
  const { size } = meshing;
  const reading = { size, openOther, scale, units, fileUnits, signal };
  // Without a name, the reader says so.
  const read = await readSurface(file, { ...reading, fileName } as ReadFileOptions);
  if (!read.success) return unopened(read);
  const isCad = isCadFile(fileName ?? "");
  return withMesher(mesher, control, (made) => meshedSurface(made, read.value, { meshing, isCad, control }));
}

const PROJECT_EXTENSION = ".json";

/** Returns the name of a `File`; undefined for other bytes. */
function nameOf(file: ByteSource): string | undefined {
  const { name } = asObject(file as Partial<File>);
  return typeof name === "string" ? name : undefined;
}

function checkMesher(mesher: unknown): Diagnostic[] {
  if (mesher === undefined || typeof asObject(mesher as Mesher).meshSurface === "function") return [];
  return [
    invalidOption("mesher", `the mesher is ${shown(mesher)}`, "Pass a mesher that is open, or omit it."),
  ];
}

async function bytesOf(file: ByteSource, signal: AbortSignal | undefined): Promise<Uint8Array> {
  const pieces: Uint8Array[] = [];
  for await (const piece of piecesOf(file, signal)) pieces.push(piece);
  return joined(pieces);
}

/** Returns the result for a file that could not be read. */
export function unopened({ errors }: Extract<ReadResult<never>, { readonly success: false }>): MeshedFile {
  return failed(errors.map((error) => readDiagnostic(error)));
}

function failed(
  diagnostics: readonly Diagnostic[],
  status: Exclude<MeshStatus, "done"> = "invalid-input",
): MeshedFile {
  const report = { ...emptyReport(status, diagnostics), regions: [] };
  return { success: false, message: messageOf(report), mesh: undefined, report, notes: [] };
}

/** Calls `use` with the given mesher, or with one of its own. */
async function withMesher<T>(
  given: Mesher | undefined,
  { signal }: RunControl,
  use: (mesher: Mesher) => Promise<T>,
): Promise<T> {
  if (given !== undefined) return use(given);
  const own = await createMesher({ signal });
  try {
    return await use(own);
  } finally {
    own.dispose();
  }
}

async function meshedProject(
  mesher: Mesher,
  project: Project,
  options: SurfaceMeshOptions,
  control: RunControl,
): Promise<MeshedFile> {
  const option = surfaceOption(options);
  if (option !== undefined) {
    const message = `\`${option}\` is for surfaces, but the file is a project`;
    return failed([invalidOption(option, message, "Omit it: each body has a treatment of its own.")]);
  }
  const result = await mesher.meshProject(project, projectPart(options), control);
  return outcome(result);
}

interface SurfaceMeshingOptions {
  readonly meshing: SurfaceMeshOptions;
  readonly isCad: boolean;
  readonly control: RunControl;
}

async function meshedSurface(
  mesher: Mesher,
  given: Mesh,
  { meshing, isCad, control }: SurfaceMeshingOptions,
): Promise<MeshedFile> {
  const made = await surfaceMeshed(mesher, given, meshing, control, {
    isCad,
    hasInterfacePatches: isCad,
  });
  const { surface, changes, repairDeviation = 0, split, refinement, remesh } = made;
  const notes = [
    ...readingNotes(given),
    ...(changes === undefined ? [] : [`repair: ${repairText(changes, repairDeviation)}`]),
    ...(split === undefined ? [] : [splitText(split)]),
    ...(refinement === undefined ? [] : [refinementText(refinement)]),
    ...(remesh === undefined ? [] : [remeshText(remesh, "report.remesh")]),
  ];
  const done = {
    ...(changes && { repair: changes, repairDeviation }),
    ...(refinement && { refinement }),
    ...(remesh && { remesh }),
  };
  return outcome(made, { surface, notes, done });
}

interface Done {
  /** The surface that was meshed. */
  readonly surface?: Mesh;
  readonly notes?: readonly string[];
  readonly done?: Omit<MeshFileReport, keyof MeshReport>;
}

function outcome(
  { mesh: made, report }: MeshResult,
  { surface, notes = [], done = {} }: Done = {},
): MeshedFile {
  const { diagnostics, status } = report;
  const mesh = made.tetrahedra.length === 0 ? undefined : made;
  const left = mesh === undefined || surface === undefined ? [] : unmeshedNotes(surface, mesh);
  const others = diagnostics.filter(({ severity }) => severity !== "error");
  const all = [...notes, ...left, ...diagnosticLines(others).map(({ text }) => text)];
  const whole = { report: { ...report, ...done }, notes: all };
  if (status === "done" && mesh !== undefined) return { success: true, mesh, ...whole };
  return { success: false, message: messageOf(report), mesh, ...whole };
}

/** Number of lines of a message. */
const MAX_LINES = 4;

/** Returns the first problems, an example of each kind, and the number of the others. */
function messageOf({ status, diagnostics }: Pick<MeshReport, "status" | "diagnostics">): string {
  if (status === "cancelled") return "The call was cancelled.";
  const errors = diagnostics.filter(({ severity }) => severity === "error");
  const lines = diagnosticLines(errors.length > 0 ? errors : diagnostics, 1).map(({ text }) => text);
  return lines.length === 0 ? "There is no mesh." : lines.slice(0, MAX_LINES).join(" ");
}
