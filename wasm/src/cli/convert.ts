/** `tetrafront convert`: one mesh file into another format; of a volume mesh its boundary, if that is all it takes. */
import { FileProblem, refuseFolder, writeOutput } from "./files.js";
import { withMesher } from "./grids.js";
import { formatName, readMeshFile } from "./input.js";
import { ExitCode, say, tell, toldFailure } from "./messages.js";
import { checkApart, checkWritable, inputFiles, outputFiles } from "./places.js";
import { refuseRepair, repaired, repairOptions, tellChanges, type RepairCommandOptions } from "./repair.js";
import { mixedTurns, readingLines } from "./tables.js";
import { boundaryOf } from "../formats/boundary.js";
import type { Contents, WrittenFile } from "../formats/file-format.js";
import { extensionOf, extensionsThat, formatOf } from "../formats/file-formats.js";
import { numbered, type FileMesh } from "../formats/file-mesh.js";
import { leftData } from "../formats/held.js";
import { writeMesh } from "../formats/mesh-files.js";
import { inSteps } from "../formats/steps.js";
import { surfaceOf, type SurfaceFile } from "../formats/surface-file.js";
import { misfits, tetFaces } from "../formats/tet-faces.js";
import type { RepairOptions } from "../api/inspection.js";
import { plural } from "../base/plural.js";
import type { Diagnostic } from "../api/types.js";

/** As commander hands them over. */
export interface ConvertCommandOptions extends RepairCommandOptions {
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
    await refuseFolder(output);
    const name = writableName(output, options.to, ["surface", "volume"]);
    const written = outputFiles(output, options.to);
    await checkApart(inputFiles(input, options.from), written);
    await checkWritable(written);
    const given = await readMeshFile(input, options.from);
    const mesh = await prepared(given, { input, output, name, repair, isQuiet });
    await writeAll(await writeMesh(mesh, name), { input, output, name, isQuiet });
    if (!isQuiet) {
      const faces = await inSteps(tetFaces(mesh));
      tell(input, (await inSteps(misfits(mesh, faces))).map(asWarning), { isQuiet });
      const left = [...given.nodeData.keys()].filter((key) => !mesh.nodeData.has(key));
      if (left.length > 0) say(`note: ${input}: ${leftData(left)}`);
      const notes = [...mixedTurns(given), ...readingLines(given)];
      for (const line of notes) say(`note: ${input}: ${line}`);
      say(`${input}: ${contentsOf(mesh)} -> ${output}`);
    }
    return ExitCode.meshed;
  } catch (failure) {
    return toldFailure(failure, input);
  }
}

/** The name that tells the output's format. Throws a FileProblem where none of `contents` can be written as that. */
export function writableName(output: string, to: string | undefined, contents: readonly Contents[]): string {
  const name = formatName(output, to);
  if (contents.some((held) => formatOf(name)?.writes.includes(held))) return name;
  const known = new Set(contents.flatMap((held) => extensionsThat("writes", held)));
  const extension = extensionOf(name);
  throw new FileProblem(
    output,
    extension === ""
      ? "the name has no extension to tell the format"
      : `"${extension}" is no format that can be written here`,
    `Give a name that ends in ${[...known].join(" or ")}, or say it by --to.`,
  );
}

/** Where a mesh goes, and what is told of it. */
export interface Destination {
  readonly input: string;
  readonly output: string;
  /** Tells the output's format. */
  readonly name: string;
  readonly isQuiet: boolean;
}

/** Writes the files of one mesh, and says what its format left out. */
export async function writeAll(
  files: readonly WrittenFile[],
  { input, output, name, isQuiet }: Destination,
): Promise<void> {
  for (const { notes } of files) tell(input, notes, { isQuiet });
  for (const { fileName, bytes } of files) await writeOutput(fileName === name ? output : fileName, bytes);
}

interface Conversion extends Destination {
  readonly repair: RepairOptions | undefined;
}

async function prepared(mesh: FileMesh, conversion: Conversion): Promise<FileMesh> {
  const { output, name, repair } = conversion;
  const writes = formatOf(name)?.writes ?? [];
  if (mesh.tetrahedra.length > 0) {
    if (writes.includes("volume")) refuseRepair(repair, "a mesh of tetrahedra");
    const whole = mesh.triangles.length > 0 ? mesh : await withBoundary(mesh);
    return writes.includes("volume") ? whole : surfaceFrom(await inSteps(boundaryOf(whole)), conversion);
  }
  if (!writes.includes("surface")) {
    const known = extensionsThat("writes", "surface").join(", ");
    const remedy = known === "" ? "Mesh it." : `Mesh it, or give a name that ends in one of ${known}.`;
    throw new FileProblem(output, "a surface cannot be written in a format of volume meshes", remedy);
  }
  return surfaceFrom(mesh, conversion);
}

async function surfaceFrom(mesh: FileMesh, { input, repair, isQuiet }: Conversion): Promise<FileMesh> {
  const given = await inSteps(surfaceOf(mesh));
  if (repair === undefined) return welded(mesh, given);
  const { surface, changes } = await withMesher((mesher) => repaired(mesher, given, repair));
  if (!isQuiet && changes !== undefined) tellChanges(input, changes);
  return { ...mesh, ...surface, nodeData: new Map() };
}

/** A format whose faces need not fit together takes such a mesh, but hardly any program can use it. */
function asWarning(fault: Diagnostic): Diagnostic {
  return { ...fault, severity: "warning" };
}

/** Triangles that share places share nodes; that is what formats with nodes are for. */
function welded(mesh: FileMesh, surface: SurfaceFile): FileMesh {
  const { points, triangles, trianglePatch, patches } = surface;
  const isSame = points.length === mesh.points.length;
  return { ...mesh, points, triangles, trianglePatch, patches, nodeData: isSame ? mesh.nodeData : new Map() };
}

/** With the faces of one element as its triangles, one patch for each region. */
async function withBoundary(mesh: FileMesh): Promise<FileMesh> {
  const regions = mesh.tetrahedronRegion;
  const { boundary } = await withMesher((mesher) => mesher.inspectMesh({ ...mesh, regions }));
  return {
    ...mesh,
    triangles: boundary.triangles,
    trianglePatch: boundary.region,
    patches: numbered("boundary", mesh.regions.length),
  };
}

function contentsOf({ points, triangles, tetrahedra }: FileMesh): string {
  const parts = [plural(points.length / 3, "point"), plural(triangles.length / 3, "triangle")];
  return [...parts, ...(tetrahedra.length > 0 ? [plural(tetrahedra.length / 4, "tetrahedron")] : [])].join(
    ", ",
  );
}
