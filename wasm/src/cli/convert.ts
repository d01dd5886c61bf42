/**
 * `tetrafront convert`: converts a mesh file to another format; of a volume mesh the boundary, if the format stores
 * surfaces only; to a project with its bodies.
 */
import { readingNotes } from "../api/reading-notes.js";
import path from "node:path";
import { streamedMesh, type WriteFileOptions } from "../api/mesh-files.js";
import type { RepairOptions } from "../api/option-types.js";
import { repaired } from "../api/surface-preparation.js";
import { splitText } from "../api/treatment-texts.js";
import { plural } from "../base/plural.js";
import { inSteps } from "../calls/yielder.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { boundaryOf } from "../formats/boundary.js";
import type { Contents } from "../formats/file-format.js";
import { extensionOf, extensionsFor, formatOf } from "../formats/file-formats.js";
import { fileSpool } from "../formats/file-spool.js";
import { omittedDataMessage } from "../formats/format-limits.js";
import { numbered } from "../formats/groups.js";
import { surfaceOf } from "../formats/surface-file.js";
import { findDefects, tetFaces } from "../formats/tet-faces.js";
import type { Mesh } from "../mesh/mesh.js";
import { createBodies } from "../project/solid-bodies.js";
import { writeProject } from "../project/project.js";
import { PROJECT_FORMAT, type Project, type ProjectBody } from "../project/project-types.js";
import { PROJECT_VERSION } from "../project/versions.js";
import { elementOrderFor, type ElementOrderOption } from "./element-order.js";
import { FileError, refuseFolder, STANDARD_STREAM, temporaryFolderFor, writeOutput } from "./files.js";
import { withMesher } from "./grids.js";
import { formatName, isProject, readMeshFile } from "./input.js";
import { ExitCode, print, printDiagnostics, reportFailure } from "./messages.js";
import { checkNoOverwrite, checkWritable, inputFiles, outputFiles } from "./paths.js";
import { printChanges, refuseRepair, type RepairCommandOptions, repairOptions } from "./repair.js";
import { type SplitCommandOptions, splitOptions, withSplit } from "./splitting.js";
import { enterStage } from "./stages.js";
import type { UnitOptions } from "./units.js";
import { mixedOrientationLines, unusedPointLines } from "./tables.js";

/** Options as commander passes them. */
export interface ConvertCommandOptions
  extends RepairCommandOptions, SplitCommandOptions, ElementOrderOption, UnitOptions {
  readonly output: string;
  readonly from?: string;
  readonly to?: string;
  readonly quiet?: boolean;
}

/** Runs the command; resolves with the exit code. */
export async function convertFile(input: string, options: ConvertCommandOptions): Promise<number> {
  try {
    const { output, quiet: isQuiet = false } = options;
    const repair = repairOptions(options);
    splitOptions(options);
    await refuseFolder(output);
    if (isProject(output, options.to)) return await convertToProject(input, options, repair);
    const name = writableName(output, options.to, ["surface", "volume"]);
    const elementOrder = elementOrderFor(options, name);
    const written = outputFiles(output, options.to);
    await checkNoOverwrite(inputFiles(input, options.from), written);
    await checkWritable(written);
    const given = await readMeshFile(input, options);
    const whole = await prepared(given, { input, output, name, repair, isQuiet });
    const mesh = await withSplitPatches(input, whole, options);
    await writeMeshTo({ input, output, name, isQuiet }, mesh, { elementOrder });
    if (!isQuiet) {
      const faces = await inSteps(tetFaces(mesh));
      printDiagnostics(input, (await inSteps(findDefects(mesh, faces))).map(asWarning), { isQuiet });
      const left = [...given.nodeData.keys()].filter((key) => !mesh.nodeData.has(key));
      if (left.length > 0) print(`note: ${input}: ${omittedDataMessage(left)}`);
      const notes = [
        ...mixedOrientationLines(given),
        ...readingNotes({ ...given, notes: whole.notes }),
        ...unusedPointLines(given),
      ];
      for (const line of notes) print(`note: ${input}: ${line}`);
      print(`${input}: ${contentsOf(mesh)} -> ${output}`);
    }
    return ExitCode.meshed;
  } catch (failure) {
    return reportFailure(failure, input);
  }
}

/** Writes a project with a body per solid of the surface. */
async function convertToProject(
  input: string,
  options: ConvertCommandOptions,
  repair: RepairOptions | undefined,
): Promise<number> {
  const { output, from, to, quiet: isQuiet = false } = options;
  const written = outputFiles(output, to);
  await checkNoOverwrite(inputFiles(input, from), written);
  await checkWritable(written);
  const given = await readMeshFile(input, options);
  const whole = given.triangles.length > 0 ? given : await withBoundary(given);
  const surface = await surfaceFrom(await inSteps(boundaryOf(whole)), {
    input,
    output,
    name: output,
    repair,
    isQuiet,
  });
  const mesh = await withSplitPatches(input, surface, options);
  const name = input === STANDARD_STREAM ? "surface" : path.basename(input, path.extname(input));
  await writeOutput(
    output,
    writeProject(projectOf(name, mesh.unit, createBodies(mesh, { id: 1, firstPatchId: 1, name }))),
  );
  if (!isQuiet) {
    const left = [...given.nodeData.keys()];
    if (left.length > 0) print(`note: ${input}: ${omittedDataMessage(left)}`);
    for (const line of [...readingNotes(given), ...unusedPointLines(given)]) print(`note: ${input}: ${line}`);
    print(`${input}: ${contentsOf(mesh)} -> ${output}`);
  }
  return ExitCode.meshed;
}

async function withSplitPatches(input: string, mesh: Mesh, options: ConvertCommandOptions): Promise<Mesh> {
  const split = splitOptions(options);
  if (split === undefined || mesh.triangles.length === 0) return mesh;
  const made = await withMesher((mesher) => withSplit(mesher, mesh, split));
  if (options.quiet !== true)
    print(`${input}: ${splitText({ before: mesh.patches.length, after: made.patches.length })}`);
  return made;
}

function projectOf(name: string, units: string | undefined, bodies: readonly ProjectBody[]): Project {
  return {
    format: PROJECT_FORMAT,
    version: PROJECT_VERSION,
    name,
    ...(units !== undefined && { units }),
    points: [],
    lines: [],
    patches: [],
    bodies,
    background: { nodes: [], tetrahedra: [] },
  };
}

/** Returns a name with the output's extension. Throws a FileError if the format cannot write any of `contents`. */
export function writableName(output: string, to: string | undefined, contents: readonly Contents[]): string {
  const name = formatName(output, to);
  if (contents.some((held) => formatOf(name)?.writable.includes(held))) return name;
  const known = new Set(contents.flatMap((held) => extensionsFor("write", held)));
  const extension = extensionOf(name);
  throw new FileError(
    output,
    extension === "" ? "the name has no extension" : `"${extension}" files cannot be written here`,
    `Use a name that ends in ${[...known].join(" or ")}, or set the format with --to.`,
  );
}

/** Destination of a mesh. */
export interface Destination {
  readonly input: string;
  readonly output: string;
  /** Name whose extension selects the format. */
  readonly name: string;
  readonly isQuiet: boolean;
}

/** Writes the files of one mesh while their bytes are made; prints and returns what its format cannot store. */
export async function writeMeshTo(
  { input, output, name, isQuiet }: Destination,
  mesh: Mesh,
  options: WriteFileOptions = {},
): Promise<readonly Diagnostic[]> {
  const folder = await temporaryFolderFor(output);
  const { written, omitted } = forOutput(mesh, output, name);
  const { files, notes: found } = await streamedMesh(written, name, options, () => fileSpool(folder));
  enterStage(`writing ${output}`);
  for (const { fileName, pieces } of files) await writeOutput(fileName === name ? output : fileName, pieces);
  const notes = [...omitted, ...found];
  printDiagnostics(input, notes, { isQuiet });
  return notes;
}

/** Returns the mesh without values that the format keeps in a second file if there is only a stream, and says so. */
function forOutput(mesh: Mesh, output: string, name: string) {
  const isOneFile = output === STANDARD_STREAM && formatOf(name)?.valuesExtension !== undefined;
  if (!isOneFile || mesh.nodeData.size === 0) return { written: mesh, omitted: [] };
  const message = omittedDataMessage([...mesh.nodeData.keys()]);
  const remedy = "Write to a file, beside which there is room for them.";
  const omitted = [packageDiagnostic("left-out", message, remedy, "information")];
  return { written: { ...mesh, nodeData: new Map() }, omitted };
}

interface Conversion extends Destination {
  readonly repair: RepairOptions | undefined;
}

async function prepared(mesh: Mesh, conversion: Conversion): Promise<Mesh> {
  const { output, name, repair } = conversion;
  const writes = formatOf(name)?.writable ?? [];
  if (mesh.tetrahedra.length > 0) {
    if (writes.includes("volume")) refuseRepair(repair, "a mesh of tetrahedra");
    const whole = mesh.triangles.length > 0 ? mesh : await withBoundary(mesh);
    return writes.includes("volume") ? whole : surfaceFrom(await inSteps(boundaryOf(whole)), conversion);
  }
  if (!writes.includes("surface")) {
    const known = extensionsFor("write", "surface").join(", ");
    const remedy = `Mesh it with "tetrafront mesh", or use a name that ends in one of ${known}.`;
    throw new FileError(output, "the format stores volume meshes, but the input is a surface", remedy);
  }
  return surfaceFrom(mesh, conversion);
}

async function surfaceFrom(mesh: Mesh, { input, repair, isQuiet }: Conversion): Promise<Mesh> {
  const given = await inSteps(surfaceOf(mesh));
  if (repair === undefined) return welded(mesh, given);
  const made = await withMesher((mesher) => repaired(mesher, given, repair));
  if (!isQuiet) printChanges(input, made);
  return { ...mesh, ...made.surface, nodeData: new Map() };
}

/** Returns the defect as a warning: the format can store such a mesh, but hardly any program can use it. */
function asWarning(defect: Diagnostic): Diagnostic {
  return { ...defect, severity: "warning" };
}

/** Replaces the triangles by the exactly welded surface, as formats with nodes expect. */
function welded(mesh: Mesh, surface: Mesh): Mesh {
  const { points, triangles, trianglePatch, patches, notes } = surface;
  const isSame = points.length === mesh.points.length;
  return {
    ...mesh,
    points,
    triangles,
    trianglePatch,
    patches,
    notes,
    nodeData: isSame ? mesh.nodeData : new Map(),
  };
}

/** Adds the boundary faces as triangles, one patch per region. */
export async function withBoundary(mesh: Mesh): Promise<Mesh> {
  const { boundary } = await withMesher((mesher) => mesher.inspectMesh(mesh));
  return {
    ...mesh,
    triangles: boundary.triangles,
    trianglePatch: boundary.region,
    patches: numbered("boundary", mesh.regions.length),
  };
}

function contentsOf({ points, triangles, tetrahedra }: Mesh): string {
  const parts = [plural(points.length / 3, "point"), plural(triangles.length / 3, "triangle")];
  return [...parts, ...(tetrahedra.length > 0 ? [plural(tetrahedra.length / 4, "tetrahedron")] : [])].join(
    ", ",
  );
}
