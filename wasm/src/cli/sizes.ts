/** Sizes on the command line: `--size`, `--source` and `--background`. */
import type { Mesher } from "../api/mesher-interface.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { invalidOption } from "../diagnostics/package-diagnostic.js";
import { type BackgroundArrays, checkBackground } from "../project/background-arrays.js";
import type { ProjectSource } from "../project/project-types.js";
import { gridArrays, type GridInput, numberIn, readGrid } from "./input.js";
import { InvalidInput, print, printDiagnostics } from "./messages.js";
import { inputFiles, type NamedFile } from "./paths.js";
import { unusedLines } from "./tables.js";

/** Options as commander passes them. */
export interface SizeCommandOptions {
  readonly size?: string;
  readonly elements?: string;
  readonly growth?: string;
  readonly source?: readonly string[];
  readonly background?: string;
}

/** Sizes that do not need a file to be read. */
export interface GivenSizes {
  readonly size: number | undefined;
  readonly growth: number | undefined;
  /** The sources as a background grid without nodes, which has no other effect. */
  readonly background?: BackgroundArrays;
}

/** Returns the sizes, unchecked. Throws an InvalidInput if a source cannot be parsed. */
export function sizesIn({ size, growth, source }: SizeCommandOptions): GivenSizes {
  const sizes = { size: numberIn(size), growth: numberIn(growth) };
  if (source === undefined) return sizes;
  const none = new Float64Array();
  const sources = source.map(sourceIn);
  return { ...sizes, background: { points: none, sizes: none, tetrahedra: new Uint32Array(), sources } };
}

/** Parses `x,y,z,size[,distance[,growth]]`. Throws an InvalidInput. */
function sourceIn(text: string, index: number): ProjectSource {
  const numbers = text.split(",").map(numberIn);
  const [x, y, z, size, distance, growth] = numbers;
  if (numbers.length > 6 || x === undefined || y === undefined || z === undefined || size === undefined) {
    const remedy =
      "Use x,y,z,size and optionally a distance and a growth, for example --source 0,0,1,0.05,0.2.";
    throw new InvalidInput("command line", [invalidOption("--source", `invalid source "${text}"`, remedy)]);
  }
  return { id: index + 1, type: "point", positions: [[x, y, z]], size, distance, growth };
}

/** Returns a diagnostic if two options both define the sizes. */
export function checkSizes({ size, background }: SizeCommandOptions): Diagnostic[] {
  if (size === undefined || background === undefined) return [];
  const message = "--size and --background exclude each other";
  return [invalidOption("--background", message, "Use one of them.")];
}

/** Returns the files of the background grid, if there is one. */
export function gridFiles({ background }: SizeCommandOptions): NamedFile[] {
  return background === undefined ? [] : inputFiles(background, undefined, "the background grid");
}

/** Background grid in the form of its file. */
export interface GivenGrid {
  readonly file: string;
  readonly grid: GridInput;
}

/** Reads the background grid, if there is one, and prints what it does not use. */
export async function readGivenGrid(
  { background: file }: SizeCommandOptions,
  isQuiet: boolean,
): Promise<GivenGrid | undefined> {
  if (file === undefined) return undefined;
  const grid = await readGrid(file);
  if (grid.kind === "volume" && !isQuiet) {
    for (const line of unusedLines(grid.volume)) print(`note: ${file}: ${line}`);
  }
  return { file, grid };
}

/** Returns options with the background grid, and with their own sources besides its sources. */
export async function withGrid<Options extends { readonly background?: BackgroundArrays | undefined }>(
  mesher: Mesher,
  options: Options,
  given: GivenGrid | undefined,
): Promise<Options> {
  if (given === undefined) return options;
  const grid = await gridArrays(mesher, given.file, given.grid);
  const wrong = checkBackground(grid);
  if (wrong.length > 0) throw new InvalidInput(given.file, wrong);
  const sources = [...(grid.sources ?? []), ...(options.background?.sources ?? [])];
  return { ...options, background: { ...grid, sources } };
}

/** Prints diagnostics about the background grid with the name of its own file. */
export function printWithGrid(
  { input, background }: { readonly input: string; readonly background: string | undefined },
  diagnostics: readonly Diagnostic[],
  isQuiet: boolean,
): void {
  const isOfGrid = ({ code, entities: [first] }: Diagnostic) =>
    background !== undefined &&
    (code === "empty-background-grid" || first?.kind.startsWith("background-") === true);
  printDiagnostics(background ?? input, diagnostics.filter(isOfGrid), { isQuiet });
  printDiagnostics(
    input,
    diagnostics.filter((found) => !isOfGrid(found)),
    { isQuiet },
  );
}
