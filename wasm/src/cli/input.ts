/** What the command line reads: options that are numbers, projects, surfaces, background grids. */
import { checkInput, FileProblem, openBeside, piecesOfInput, readInput, STANDARD_STREAM } from "./files.js";
import { BadInput, unreadable } from "./messages.js";
import { extensionOf, extensionsThat, FILE_FORMATS } from "../formats/file-formats.js";
import type { FileMesh } from "../formats/file-mesh.js";
import { readMesh, readSurface, readVolume, type ReadFileOptions } from "../formats/mesh-files.js";
import type { SurfaceFile } from "../formats/surface-file.js";
import type { VolumeFile } from "../formats/volume-file.js";
import { backgroundArrays } from "../project/grid-arrays.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { volumeBackground } from "../formats/volume-background.js";
import { readProject } from "../project/project.js";
import type { Project } from "../project/schema.js";
import type { ReadResult } from "../formats/read-result.js";
import type { BackgroundArrays, Diagnostic, Mesher } from "../api/types.js";

export const PROJECT_EXTENSION = ".json";

export type Input =
  | { readonly kind: "project"; readonly project: Project }
  | { readonly kind: "surface"; readonly surface: SurfaceFile };

/** A background grid as its file has it; a mesh becomes one only with a mesher's help. */
export type GridInput =
  | { readonly kind: "project"; readonly background: BackgroundArrays }
  | { readonly kind: "volume"; readonly volume: VolumeFile };

/** A number as people write it: 0x10, 1_000 and the empty word are none. */
const DECIMAL = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** The number in an option's text; what is none is left for the check of options to refuse. */
export function numberIn(text: string | undefined): number | undefined {
  if (text === undefined) return undefined;
  const word = text.trim();
  return DECIMAL.test(word) ? Number(word) : (word as unknown as number);
}

/** Throws what the check of options found. */
export function refuseOptions(wrong: readonly Diagnostic[]): void {
  if (wrong.length > 0) throw new BadInput("command line", wrong);
}

/** How people name formats: by extension with or without its dot, or by the format's short name. */
export function extensionOfFormat(format: string): string {
  const word = format.toLowerCase();
  const dotted = word.startsWith(".") ? word : `.${word}`;
  if (dotted === PROJECT_EXTENSION) return PROJECT_EXTENSION;
  const known = FILE_FORMATS.find(({ id, extensions }) => id === word || extensions.includes(dotted));
  if (known !== undefined) return known.extensions.includes(dotted) ? dotted : known.extensions[0];
  throw new FileProblem(
    format || '""',
    "there is no such format",
    `Give one of ${FILE_FORMATS.map(({ id }) => id).join(", ")}, or an extension.`,
  );
}

/** A name that tells the format of `file`, which its own does not if it is a stream. */
export function formatName(file: string, format: string | undefined): string {
  if (format !== undefined)
    return `${file === STANDARD_STREAM ? "stream" : file}${extensionOfFormat(format)}`;
  if (file !== STANDARD_STREAM) return file;
  throw new FileProblem(
    "-",
    "a stream has no name to tell its format",
    "Say it by --format, or by --from and --to where input and output are streams.",
  );
}

export async function readModel(input: string, from?: string): Promise<Input> {
  const name = formatName(input, from);
  const known = [PROJECT_EXTENSION, ...extensionsThat("reads", "surface")];
  const extension = await checkedExtension(input, name, known, OR_FROM);
  if (extension === PROJECT_EXTENSION) {
    return { kind: "project", project: await readProjectFile(input, from) };
  }
  const read = await readSurface(piecesOfInput(input), openedAs(input, name));
  return { kind: "surface", surface: valueOf(input, read, name) };
}

/** All that a mesh file holds, nothing welded. */
export async function readMeshFile(input: string, from?: string): Promise<FileMesh> {
  const name = formatName(input, from);
  const known = new Set([...extensionsThat("reads", "surface"), ...extensionsThat("reads", "volume")]);
  await checkedExtension(input, name, [...known], OR_FROM);
  return valueOf(input, await readMesh(piecesOfInput(input), openedAs(input, name)), name);
}

/** Whether the input is a project: its name, or the format given, tells. */
export function isProject(input: string, from?: string): boolean {
  return extensionOf(formatName(input, from)) === PROJECT_EXTENSION;
}

export async function readProjectFile(input: string, from?: string): Promise<Project> {
  await checkedExtension(input, formatName(input, from), [PROJECT_EXTENSION]);
  return valueOf(input, readProject(new TextDecoder().decode(await readInput(input))));
}

const withoutSizes = packageDiagnostic(
  "unreadable-input",
  "the project tells no sizes: it has neither a background grid nor sources",
  "Give one that has, or a volume mesh; `tetrafront cover` and `tetrafront propose` make sizes for a project.",
);

export async function readGrid(file: string): Promise<GridInput> {
  const known = [PROJECT_EXTENSION, ...extensionsThat("reads", "volume")];
  const extension = await checkedExtension(file, file, known);
  if (extension === PROJECT_EXTENSION) {
    const { background } = await readProjectFile(file);
    if (background.tetrahedra.length === 0 && (background.sources ?? []).length === 0) {
      throw new BadInput(file, [withoutSizes]);
    }
    return { kind: "project", background: backgroundArrays(background) };
  }
  return {
    kind: "volume",
    volume: valueOf(file, await readVolume(piecesOfInput(file), openedAs(file, file)), file),
  };
}

/** Throws a BadInput about the file where the numbers at its nodes are no sizes. */
export async function gridArrays(mesher: Mesher, file: string, grid: GridInput): Promise<BackgroundArrays> {
  if (grid.kind === "project") return grid.background;
  const read = await volumeBackground(mesher, grid.volume);
  if (!read.success)
    throw new BadInput(
      file,
      read.problems.map((problem) => unreadable(problem)),
    );
  return read.value;
}

function openedAs(file: string, fileName: string): ReadFileOptions {
  return { fileName, openOther: (name) => openBeside(file, name) };
}

const OR_FROM = ", or tell the format by --from";

/** Of the name that tells the format of `file`. Throws a FileProblem, first where there is no such file. */
async function checkedExtension(
  file: string,
  name: string,
  known: readonly string[],
  otherwise = "",
): Promise<string> {
  const extension = extensionOf(name);
  if (known.includes(extension)) return extension;
  await checkInput(file);
  throw new FileProblem(
    file,
    extension === "" ? "the name has no extension to tell the format" : `"${extension}" cannot be read`,
    `Give a file that ends in ${known.length > 1 ? "one of " : ""}${known.join(", ")}${otherwise}.`,
  );
}

function valueOf<T>(file: string, read: ReadResult<T>, readAs?: string): T {
  if (read.success) return read.value;
  throw new BadInput(
    file,
    read.problems.map((problem) => unreadable(problem, readAs)),
  );
}
