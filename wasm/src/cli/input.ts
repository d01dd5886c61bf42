/** Reads the input of commands: numbers in options, projects, surfaces, background grids. */
import { type ReadFileOptions, readMesh, readSurface, readVolume } from "../api/mesh-files.js";
import type { Mesher } from "../api/mesher-interface.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { ReadResult } from "../diagnostics/read-error.js";
import { extensionOf, extensionsFor, FILE_FORMATS, isCadFile } from "../formats/file-formats.js";
import type { Mesh } from "../mesh/mesh.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import { backgroundArrays } from "../project/grid-arrays.js";
import { readProject } from "../project/project.js";
import type { Project } from "../project/project-types.js";
import { checkInput, FileError, openBeside, piecesOfInput, readInput, STANDARD_STREAM } from "./files.js";
import { asInvalidInput, InvalidInput, unreadable } from "./messages.js";
import { enterStage } from "./stages.js";
import { lengthOptions, refuseUnits, type UnitOptions } from "./units.js";

export { numberIn, refuseOptions } from "./numbers.js";

export const PROJECT_EXTENSION = ".json";

export type Input =
  | { readonly kind: "project"; readonly project: Project }
  | { readonly kind: "surface"; readonly surface: Mesh };

/** Returns the surface of an input that is known to be none else. */
export function surfaceIn(input: Input): Mesh {
  if (input.kind === "surface") return input.surface;
  throw new TypeError("the input is a project");
}

/** Background grid in the form of its file; a mesher converts a mesh to a grid. */
export type GridInput =
  | { readonly kind: "project"; readonly background: BackgroundArrays }
  | { readonly kind: "volume"; readonly volume: Mesh };

/** Returns the extension of a format, given as an extension with or without its dot, or by the format's id. */
export function extensionOfFormat(format: string): string {
  const word = format.toLowerCase();
  const dotted = word.startsWith(".") ? word : `.${word}`;
  if (dotted === PROJECT_EXTENSION) return PROJECT_EXTENSION;
  const known = FILE_FORMATS.find(({ id, extensions }) => id === word || extensions.includes(dotted));
  if (known !== undefined) return known.extensions.includes(dotted) ? dotted : known.extensions[0];
  throw new FileError(
    format || '""',
    "unknown format",
    `Use one of ${FILE_FORMATS.map(({ id }) => id).join(", ")}, or an extension.`,
  );
}

/** Returns a name whose extension selects the format of `file`; a stream needs `format`. */
export function formatName(file: string, format: string | undefined): string {
  if (format !== undefined)
    return `${file === STANDARD_STREAM ? "stream" : file}${extensionOfFormat(format)}`;
  if (file !== STANDARD_STREAM) return file;
  throw new FileError(
    "-",
    "the format of a stream must be given",
    "Use --format, or --from and --to if both input and output are streams.",
  );
}

/** Options that decide how an input is read. */
export interface InputOptions extends UnitOptions {
  /** Format. */
  readonly from?: string | undefined;
}

/** `size`: target edge length, if it is given. */
export async function readModel(
  input: string,
  { from, ...lengths }: InputOptions,
  size?: number,
): Promise<Input> {
  const name = formatName(input, from);
  const known = [PROJECT_EXTENSION, ...extensionsFor("read", "surface")];
  const extension = await checkedExtension(input, name, known, OR_FROM);
  if (extension === PROJECT_EXTENSION) {
    refuseUnits(lengths);
    return { kind: "project", project: await readProjectFile(input, from) };
  }
  enterStage(`reading ${input}`);
  const read = await readSurface(piecesOfInput(input), {
    ...openedAs(input, name),
    size,
    ...lengthOptions(lengths),
  });
  return { kind: "surface", surface: valueOf(input, read, name) };
}

/** Reads all contents of a mesh file without welding. */
export async function readMeshFile(input: string, { from, ...lengths }: InputOptions = {}): Promise<Mesh> {
  const name = formatName(input, from);
  const known = new Set([...extensionsFor("read", "surface"), ...extensionsFor("read", "volume")]);
  await checkedExtension(input, name, [...known], OR_FROM);
  const options = { ...openedAs(input, name), ...lengthOptions(lengths) };
  enterStage(`reading ${input}`);
  return valueOf(input, await readMesh(piecesOfInput(input), options), name);
}

/** Returns whether the input is a project, by its name or the given format. */
export function isProject(input: string, from?: string): boolean {
  return extensionOf(formatName(input, from)) === PROJECT_EXTENSION;
}

/** Returns whether the input describes shapes, by its name or the given format. */
export function isCadInput(input: string, from?: string): boolean {
  return isCadFile(formatName(input, from));
}

export async function readProjectFile(input: string, from?: string): Promise<Project> {
  await checkedExtension(input, formatName(input, from), [PROJECT_EXTENSION]);
  return valueOf(input, readProject(new TextDecoder().decode(await readInput(input))));
}

const withoutSizes = packageDiagnostic(
  "unreadable-input",
  "the project has no sizes: it has neither a background grid nor sources",
  "Use a project with sizes, or a volume mesh; `tetrafront cover` and `tetrafront propose` add sizes to a project.",
);

export async function readGrid(file: string): Promise<GridInput> {
  const known = [PROJECT_EXTENSION, ...extensionsFor("read", "volume")];
  const extension = await checkedExtension(file, file, known);
  if (extension === PROJECT_EXTENSION) {
    const { background } = await readProjectFile(file);
    if (background.tetrahedra.length === 0 && (background.sources ?? []).length === 0) {
      throw new InvalidInput(file, [withoutSizes]);
    }
    return { kind: "project", background: backgroundArrays(background) };
  }
  return {
    kind: "volume",
    volume: valueOf(file, await readVolume(piecesOfInput(file), openedAs(file, file)), file),
  };
}

/** Returns the arrays of a grid. Throws an InvalidInput about its file if the values at its nodes are not valid sizes. */
export async function gridArrays(mesher: Mesher, file: string, grid: GridInput): Promise<BackgroundArrays> {
  if (grid.kind === "project") return grid.background;
  return mesher.backgroundFromMesh(grid.volume).catch((failure: unknown) => {
    throw asInvalidInput(failure, file) ?? failure;
  });
}

function openedAs(file: string, fileName: string): ReadFileOptions {
  return { fileName, openOther: (name) => openBeside(file, name) };
}

const OR_FROM = ", or set the format with --from";

/**
 * Returns the extension of `name`, which selects the format of `file`. Throws a FileError if it is not in `known`;
 * first if there is no such file.
 */
async function checkedExtension(
  file: string,
  name: string,
  known: readonly string[],
  otherwise = "",
): Promise<string> {
  const extension = extensionOf(name);
  if (known.includes(extension)) return extension;
  await checkInput(file);
  throw new FileError(
    file,
    extension === "" ? "the name has no extension" : `"${extension}" files cannot be read here`,
    `Use a file whose name ends in ${known.length > 1 ? "one of " : ""}${known.join(", ")}${otherwise}.`,
  );
}

function valueOf<T>(file: string, read: ReadResult<T>, readAs?: string): T {
  if (read.success) return read.value;
  throw new InvalidInput(
    file,
    read.errors.map((error) => unreadable(error, readAs)),
  );
}
