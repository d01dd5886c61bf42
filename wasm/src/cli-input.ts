/** What the command line reads: options that are numbers, projects, surfaces, background grids. */
import { FileProblem, openBeside, piecesOfInput, readInput } from "./cli-files.js";
import { BadInput, unreadable } from "./cli-messages.js";
import { extensionOf, extensionsThat } from "./formats/file-formats.js";
import { readSurface, readVolume, type ReadFileOptions } from "./formats/mesh-files.js";
import type { SurfaceFile } from "./formats/surface-file.js";
import type { VolumeFile } from "./formats/volume-file.js";
import { backgroundArrays } from "./grid-arrays.js";
import { volumeBackground } from "./formats/volume-background.js";
import { readProject } from "./project.js";
import type { Project } from "./project-schema.js";
import type { ReadResult } from "./read-result.js";
import type { BackgroundArrays, Diagnostic, Mesher } from "./types.js";

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

export async function readModel(input: string): Promise<Input> {
  const extension = checkedExtension(input, [PROJECT_EXTENSION, ...extensionsThat("reads", "surface")]);
  if (extension === PROJECT_EXTENSION) return { kind: "project", project: await readProjectFile(input) };
  const read = await readSurface(piecesOfInput(input), openedAs(input));
  return { kind: "surface", surface: valueOf(input, read) };
}

export async function readProjectFile(input: string): Promise<Project> {
  checkedExtension(input, [PROJECT_EXTENSION]);
  return valueOf(input, readProject(new TextDecoder().decode(await readInput(input))));
}

export async function readGrid(file: string): Promise<GridInput> {
  const extension = checkedExtension(file, [PROJECT_EXTENSION, ...extensionsThat("reads", "volume")]);
  if (extension === PROJECT_EXTENSION) {
    const { background } = await readProjectFile(file);
    return { kind: "project", background: backgroundArrays(background) };
  }
  return { kind: "volume", volume: valueOf(file, await readVolume(piecesOfInput(file), openedAs(file))) };
}

/** Throws a BadInput about the file where the numbers at its nodes are no sizes. */
export async function gridArrays(mesher: Mesher, file: string, grid: GridInput): Promise<BackgroundArrays> {
  if (grid.kind === "project") return grid.background;
  const read = await volumeBackground(mesher, grid.volume);
  if (!read.success) throw new BadInput(file, read.problems.map(unreadable));
  return read.value;
}

function openedAs(file: string): ReadFileOptions {
  return { fileName: file, openOther: (name) => openBeside(file, name) };
}

function checkedExtension(file: string, known: readonly string[]): string {
  const extension = extensionOf(file);
  if (known.includes(extension)) return extension;
  throw new FileProblem(
    file,
    extension === "" ? "the name has no extension to tell the format" : `"${extension}" cannot be read`,
    `Give a file that ends in ${known.length > 1 ? "one of " : ""}${known.join(", ")}.`,
  );
}

function valueOf<T>(file: string, read: ReadResult<T>): T {
  if (read.success) return read.value;
  throw new BadInput(file, read.problems.map(unreadable));
}
