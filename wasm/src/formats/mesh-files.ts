/** Reading and writing mesh files of any format: the file's name tells which. */
import { aFunction, checkArgument, objectOf, orNothing, shown } from "../base/argument-checks.js";
import { throwIfCancelled, untilCancelled } from "../base/cancelling.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import { asTooLarge, failureIn, ReadFailure, readSafely, type ReadResult } from "./read-result.js";
import type { Diagnostic } from "../api/types.js";
import { joined, piecesIn } from "./bytes.js";
import { checkSource, watcher, type ByteSource } from "./byte-source.js";
import type { Contents, FileFormat, FileParts, OpenOther, WrittenFile } from "./file-format.js";
import { extensionsThat, formatOf } from "./file-formats.js";
import type { FileMesh } from "./file-mesh.js";
import { checkFileMesh } from "./mesh-checks.js";
import { Breather, inSteps, STEP } from "./steps.js";
import { surfaceOf, type SurfaceFile } from "./surface-file.js";
import { volumeOf, type VolumeFile } from "./volume-file.js";

/** How a file is read. */
export interface ReadFileOptions {
  /** Its extension tells the format. */
  readonly fileName: string;
  /** Gives the other files of formats that have several, such as TetGen's `.node` beside its `.face`. */
  readonly openOther?: OpenOther | undefined;
  /**
   * Called with the number of bytes read so far, of all files together, once per piece. Of formats that can only be
   * decoded as a whole (VTU, VTP) bytes count in part when they arrive, and in full when they are decoded.
   */
  readonly onProgress?: ((bytes: number) => void) | undefined;
  /** Aborting rejects with a `MesherError` of the code `cancelled`, also while bytes are waited for; the source is let go of. */
  readonly signal?: AbortSignal | undefined;
}

/** How far the writing of a mesh is. */
export interface WriteProgress {
  /** Of the whole, 0 to 1, estimated, never decreasing. */
  readonly fraction: number;
  /** Made so far, in all files together. */
  readonly bytes: number;
}

/** How a file is written. */
export interface WriteFileOptions {
  /** Called every few milliseconds, and at the end. */
  readonly onProgress?: ((progress: WriteProgress) => void) | undefined;
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
  return asResult(async () =>
    inSteps(surfaceOf(await readAny(source, options, ["surface"])), options.signal),
  );
}

/** The tetrahedra of a file with the nodes they use and the numbers at these. */
export function readVolume(source: ByteSource, options: ReadFileOptions): Promise<ReadResult<VolumeFile>> {
  return asResult(async () => inSteps(volumeOf(await readAny(source, options, ["volume"])), options.signal));
}

/** All triangles and tetrahedra of a file as they are in it, nothing welded. */
export function readMesh(source: ByteSource, options: ReadFileOptions): Promise<ReadResult<FileMesh>> {
  return asResult(() => readAny(source, options, ["surface", "volume"]));
}

/**
 * The files that a mesh becomes in the format of this name: one, or several beside each other, with notes of what the
 * format has no place for. Formats that hold surfaces only get the triangles. Works in steps of a few milliseconds, between
 * which others run. Rejects with a `MesherError` of the code
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
  const { signal } = options;
  throwIfCancelled(signal);
  const format = typeof fileName === "string" ? formatOf(fileName) : undefined;
  const { write, passes = USUAL_PASSES } = (await format?.load()) ?? {};
  if (write === undefined) {
    const message = `the name ${shown(fileName)} tells no format that can be written`;
    const known = [...extensionsThat("writes", "volume"), ...extensionsThat("writes", "surface")];
    const remedy = `Give a name that ends in one of ${known.join(", ")}.`;
    refuse([packageDiagnostic("unknown-format", message, remedy)]);
    return [];
  }
  refuse(await inSteps(checkFileMesh(mesh), signal));
  const notes: Diagnostic[] = [];
  const files = write(mesh, fileName, (message) =>
    notes.push(packageDiagnostic("left-out", message, "", "information")),
  );
  const rows = (mesh.points.length + mesh.triangles.length) / 3 + mesh.tetrahedra.length / 4;
  const contents = await gathered(files, options, (passes * rows) / STEP);
  return contents.map((content, f) => ({ ...content, notes: f === 0 ? notes : [] }));
}

/** Of writers that say nothing else. */
const USUAL_PASSES = 4;
/** What is told before the end: more than was expected may still come. */
const NEARLY_ALL = 0.99;

/** The bytes of the files. Lets others in between their pieces, of which so many are `expected`. */
async function gathered(
  files: readonly FileParts[],
  { signal, onProgress }: WriteFileOptions,
  expected: number,
): Promise<Omit<WrittenFile, "notes">[]> {
  const breather = new Breather(signal);
  const contents: Omit<WrittenFile, "notes">[] = [];
  let [steps, bytes] = [0, 0];
  for (const { fileName, parts } of files) {
    const pieces: Uint8Array[] = [];
    for (const piece of piecesIn(parts)) {
      steps++;
      bytes += piece.length;
      if (piece.length > 0) pieces.push(piece);
      if (!breather.isDue) continue;
      onProgress?.({ fraction: Math.min(NEARLY_ALL, steps / expected), bytes });
      await breather.breathe();
    }
    contents.push({ fileName, bytes: joined(pieces) });
  }
  onProgress?.({ fraction: 1, bytes });
  return contents;
}

async function readAny(
  source: ByteSource,
  options: ReadFileOptions,
  contents: readonly Contents[],
): Promise<FileMesh> {
  checkSource(source);
  const { fileName, signal, openOther = () => Promise.resolve(undefined) } = checkedOptions(options);
  throwIfCancelled(signal);
  const format = formatOf(fileName);
  if (!format?.reads.some((held) => contents.includes(held))) throw unknownFormat(fileName, format, contents);
  const { read, arrival = 1 } = await format.load();
  if (read === undefined) throw unknownFormat(fileName, format, contents);
  try {
    const { onProgress } = options;
    let arrived = 0;
    const tell = onProgress && ((share: number) => onProgress(Math.floor(share * arrived)));
    const onArrival = (bytes: number) => {
      arrived = bytes;
      tell?.(arrival);
    };
    const onWork = (fraction: number) => tell?.(arrival + (1 - arrival) * fraction);
    const watch = watcher({ signal, onProgress: onProgress && onArrival });
    const opened: OpenOther = async (name) => {
      const other = await untilCancelled(() => checkedOpening(openOther)(name), signal);
      return other && watch(other);
    };
    return await read(watch(source), { fileName, openOther: opened, signal, onWork });
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
