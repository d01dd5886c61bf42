/** Reading and writing mesh files of any format: the file's name tells which. */
import { aFunction, checkArgument, objectOf, orNothing, shown } from "../argument-checks.js";
import { throwIfCancelled, untilCancelled } from "../cancelling.js";
import { refuse } from "../mesher-error.js";
import { packageDiagnostic } from "../package-diagnostic.js";
import { asTooLarge, failureIn, ReadFailure, readSafely, type ReadResult } from "../read-result.js";
import type { Diagnostic } from "../types.js";
import { joined, piecesIn, type Part } from "./bytes.js";
import { BREATH_MS, checkSource, watcher, type ByteSource } from "./byte-source.js";
import type { Contents, FileFormat, OpenOther, WrittenFile } from "./file-format.js";
import { extensionsThat, formatOf } from "./file-formats.js";
import type { FileMesh } from "./file-mesh.js";
import { checkFileMesh } from "./mesh-checks.js";
import { surfaceOf, type SurfaceFile } from "./surface-file.js";
import { volumeOf, type VolumeFile } from "./volume-file.js";

/** How a file is read. */
export interface ReadFileOptions {
  /** Its extension tells the format. */
  readonly fileName: string;
  /** Gives the other files of formats that have several, such as TetGen's `.node` beside its `.face`. */
  readonly openOther?: OpenOther | undefined;
  /** Called with the number of bytes read so far, of all files together, once per piece. */
  readonly onProgress?: ((bytes: number) => void) | undefined;
  /** Aborting rejects with a `MesherError` of the code `cancelled`, also while bytes are waited for; the source is let go of. */
  readonly signal?: AbortSignal | undefined;
}

/** How a file is written. */
export interface WriteFileOptions {
  /** Called with the number of bytes made so far, in all files together, every few milliseconds and at the end of each. */
  readonly onProgress?: ((bytes: number) => void) | undefined;
  /** Aborting rejects with a `MesherError` of the code `cancelled`; it is heard every few milliseconds. */
  readonly signal?: AbortSignal | undefined;
}

/**
 * The triangles of a file with their patches; polygons are cut into triangles. Points of equal coordinates
 * become one; `repairSurface` with `weld` joins points within a tolerance. A file that holds tetrahedra only
 * is refused: their outside is not taken silently.
 *
 *     const read = await readSurface(file.stream(), { fileName: file.name });
 *     if (read.success) await mesher.fillSurface(read.value);
 */
export function readSurface(source: ByteSource, options: ReadFileOptions): Promise<ReadResult<SurfaceFile>> {
  return asResult(async () => surfaceOf(await readAny(source, options, ["surface"])));
}

/** The tetrahedra of a file with the nodes they use and the numbers at these. */
export function readVolume(source: ByteSource, options: ReadFileOptions): Promise<ReadResult<VolumeFile>> {
  return asResult(async () => volumeOf(await readAny(source, options, ["volume"])));
}

/** All triangles and tetrahedra of a file as they are in it, nothing welded. */
export function readMesh(source: ByteSource, options: ReadFileOptions): Promise<ReadResult<FileMesh>> {
  return asResult(() => readAny(source, options, ["surface", "volume"]));
}

/**
 * The files that a mesh becomes in the format of this name: one, or several beside each other, with notes of what the
 * format has no place for. Formats that hold surfaces only get the triangles. Others may run meanwhile, but
 * not while a mesh is laid out for its format, nor while a zip is compressed. Rejects with a `MesherError` of the code
 * `invalid-input`, whose diagnostics are `unknown-format` where the name tells no format that can be written
 * (`formatOf` tells beforehand), `invalid-arrays` where the arrays do not fit together, and `unsound-mesh` where the
 * elements do not and the format is for solvers that need it.
 */
export async function writeMesh(
  mesh: FileMesh,
  fileName: string,
  options: WriteFileOptions = {},
): Promise<readonly WrittenFile[]> {
  checkArgument("options", options, aWriting);
  const unknown = unknownOption(options, WRITE_OPTIONS);
  if (unknown !== undefined) {
    refuse([packageDiagnostic("invalid-argument", unknown.message, unknown.remedy)]);
  }
  const format = typeof fileName === "string" ? formatOf(fileName) : undefined;
  const { write } = (await format?.load()) ?? {};
  if (write === undefined) {
    const message = `the name ${shown(fileName)} tells no format that can be written`;
    const known = [...extensionsThat("writes", "volume"), ...extensionsThat("writes", "surface")];
    const remedy = `Give a name that ends in one of ${known.join(", ")}.`;
    refuse([packageDiagnostic("unknown-format", message, remedy)]);
    return [];
  }
  refuse(checkFileMesh(mesh));
  const notes: Diagnostic[] = [];
  const files = write(mesh, fileName, (message) =>
    notes.push(packageDiagnostic("left-out", message, "", "information")),
  );
  const written: WrittenFile[] = [];
  let before = 0;
  for (const { fileName: name, parts } of files) {
    const bytes = await gathered(parts, options, before);
    before += bytes.length;
    written.push({ fileName: name, bytes, notes: written.length === 0 ? notes : [] });
  }
  return written;
}

/** Lets timers and messages in between the pieces. `before`: bytes of earlier files. */
async function gathered(
  parts: Iterable<Part>,
  { signal, onProgress }: WriteFileOptions,
  before: number,
): Promise<Uint8Array<ArrayBuffer>> {
  throwIfCancelled(signal);
  const pieces: Uint8Array[] = [];
  let length = 0;
  let breathed = performance.now();
  for (const piece of piecesIn(parts)) {
    pieces.push(piece);
    length += piece.length;
    if (performance.now() - breathed < BREATH_MS) continue;
    onProgress?.(before + length);
    await new Promise((resolve) => setTimeout(resolve));
    throwIfCancelled(signal);
    breathed = performance.now();
  }
  onProgress?.(before + length);
  return joined(pieces);
}

async function readAny(
  source: ByteSource,
  options: ReadFileOptions,
  contents: readonly Contents[],
): Promise<FileMesh> {
  checkSource(source);
  const { fileName, openOther = () => Promise.resolve(undefined) } = checkedOptions(options);
  const format = formatOf(fileName);
  if (!format?.reads.some((held) => contents.includes(held))) throw unknownFormat(fileName, format, contents);
  const { read } = await format.load();
  if (read === undefined) throw unknownFormat(fileName, format, contents);
  try {
    const watch = watcher(options);
    const opened: OpenOther = async (name) => {
      const other = await untilCancelled(() => checkedOpening(openOther)(name), options.signal);
      return other && watch(other);
    };
    return await read(watch(source), { fileName, openOther: opened });
  } catch (failure) {
    throw failureIn(fileName, asTooLarge(failure));
  }
}

const WRITE_OPTIONS = ["onProgress", "signal"] satisfies (keyof WriteFileOptions)[];
const READ_OPTIONS = ["fileName", "openOther", ...WRITE_OPTIONS] satisfies (keyof ReadFileOptions)[];

/** An option that there is none of would do nothing without a word. */
function unknownOption(
  options: object,
  known: readonly string[],
): { readonly message: string; readonly remedy: string } | undefined {
  const unknown = Object.keys(options).find((name) => !known.includes(name));
  if (unknown === undefined) return undefined;
  return { message: `there is no option "${unknown}"`, remedy: remedyOf(known) };
}

function remedyOf(known: readonly string[]): string {
  return `Correct it: the options are ${known.join(", ")}.`;
}

const aWatch = {
  onProgress: orNothing(aFunction),
  signal: orNothing(objectOf({ addEventListener: aFunction, removeEventListener: aFunction })),
};
const aReading = objectOf({ openOther: orNothing(aFunction), ...aWatch });
const aWriting = objectOf(aWatch);

function checkedOptions(options: ReadFileOptions): ReadFileOptions {
  const { fileName } = (options as ReadFileOptions | null | undefined) ?? {};
  if (typeof fileName === "string") {
    const unknown = unknownOption(options, READ_OPTIONS);
    if (unknown !== undefined) throw new ReadFailure({ code: "invalid-argument", ...unknown });
    const fault = aReading(options);
    if (fault === undefined) return options;
    const remedy = remedyOf(READ_OPTIONS);
    throw new ReadFailure({ code: "invalid-argument", message: `options${fault}`, remedy });
  }
  throw new ReadFailure({
    code: "invalid-argument",
    message: "the options give no name of the file, by which its format is told",
    remedy: 'Give options with a name: { fileName: "part.stl" }.',
  });
}

function unknownFormat(
  fileName: string,
  format: FileFormat | undefined,
  contents: readonly Contents[],
): ReadFailure {
  const what = contents.length === 1 ? contents[0] : "mesh";
  const message =
    format === undefined
      ? `the name "${fileName}" tells no known format`
      : `${format.name} files cannot be read as a ${what}`;
  const known = [...new Set(contents.flatMap((held) => extensionsThat("reads", held)))];
  const remedy = `Give a file that ends in one of ${known.join(", ")}.`;
  return new ReadFailure({ code: "unknown-format", message, remedy, fileName });
}

/** What callers without type checks open may be anything. */
function checkedOpening(openOther: OpenOther): OpenOther {
  return async (name) => {
    const source = await openOther(name);
    if (source !== undefined) checkSource(source);
    return source;
  };
}

async function asResult<T>(read: () => Promise<T>): Promise<ReadResult<T>> {
  try {
    return { success: true, value: await read() };
  } catch (failure) {
    return readSafely(() => {
      throw failure;
    });
  }
}
