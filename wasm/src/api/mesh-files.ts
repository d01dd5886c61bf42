/** Reads and writes mesh files; the extension of the file name selects the format. */
import * as v from "valibot";
import { STEP } from "../base/steps.js";
import { shown } from "../base/values.js";
import { checkArgument } from "../calls/argument-checks.js";
import { throwIfCancelled, untilCancelled } from "../calls/cancelling.js";
import { problemIn, watch } from "../calls/schemas.js";
import { inSteps, Yielder } from "../calls/yielder.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { ReadResult } from "../diagnostics/read-error.js";
import { type ByteSource, checkSource, watcher } from "../formats/byte-source.js";
import { joined, type Part, piecesIn } from "../formats/bytes.js";
import type {
  BlockedMesh,
  BlockWriter,
  Contents,
  FileFormat,
  FileParts,
  OpenOther,
  StreamedFile,
  StreamedMesh,
  WrittenFile,
} from "../formats/file-format.js";
import { extensionsFor, FILE_FORMATS, formatOf } from "../formats/file-formats.js";
import { noteLostRegions } from "../formats/format-limits.js";
import { FileHead } from "../formats/other-content.js";
import { asTooLarge, failureIn, ReadFailure, readSafely } from "../formats/read-result.js";
import { withMidNodes } from "../formats/second-order.js";
import { memorySpool, type Spool } from "../formats/spool.js";
import { surfaceOf } from "../formats/surface-file.js";
import { inUnits, lengthInFile, type LengthOptions } from "../formats/units.js";
import { volumeOf } from "../formats/volume-file.js";
import { MAX_LENGTH, MIN_LENGTH } from "../generated/constants.js";
import type { ElementBlocks } from "../mesh/element-blocks.js";
import type { Mesh, ElementOrder } from "../mesh/mesh.js";
import { checkFileMesh } from "../mesh/mesh-checks.js";
import { LENGTH_UNITS } from "../mesh/units.js";

/** Options for reading a file. */
export interface ReadFileOptions extends LengthOptions {
  /** Name of the file; its extension selects the format. */
  readonly fileName: string;
  /**
   * Target edge length, in the unit after the conversion (by default, millimetres): faces of CAD files are triangulated
   * finely enough for it. By default, finely enough for automatic sizes.
   */
  readonly size?: number | undefined;
  /** Opens the other files of a format with several, such as TetGen's `.node` next to a `.face`. */
  readonly openOther?: OpenOther | undefined;
  /**
   * Called after each piece with the number of bytes read so far, of all files together. For VTU and VTP, which are
   * decoded as a whole, bytes count in part when they arrive and in full when they are decoded.
   */
  readonly onProgress?: ((bytes: number) => void) | undefined;
  /**
   * Aborting it rejects with a `MesherError` of code `cancelled`, also while bytes are awaited, and releases the
   * source.
   */
  readonly signal?: AbortSignal | undefined;
}

/** Progress of writing a mesh. */
export interface WriteProgress {
  /** Estimated fraction of the work done, 0 to 1; never decreases. */
  readonly fraction: number;
  /** Bytes generated so far, in all files together. */
  readonly bytes: number;
}

/** Options for writing a file. */
export interface WriteFileOptions {
  /**
   * 2 for second-order elements: a node at the middle of every edge, shared by all elements there: where `curvedEdges` of
   * the mesh has it, else halfway. Only formats with `hasSecondOrder` (see `FILE_FORMATS`) store them. Default 1.
   */
  readonly elementOrder?: ElementOrder | undefined;
  /**
   * Elements of the mesh that are handed out in blocks, of the result of a run with `inBlocks`: they are read while the file is
   * written, so that it may be larger than the memory. For VTU and MSH 4.1, of order 1.
   */
  readonly blocks?: ElementBlocks | undefined;
  /** Called every few milliseconds, and at the end. */
  readonly onProgress?: ((progress: WriteProgress) => void) | undefined;
  /** Aborting it rejects with a `MesherError` of code `cancelled`, within a few milliseconds. */
  readonly signal?: AbortSignal | undefined;
}

/**
 * Reads the triangles of a file with their patches. Polygons are cut into triangles. Points with equal coordinates
 * become one node; to weld points within a distance, use `repairSurface` with `weld`. A file with tetrahedra but no
 * triangles is rejected: its boundary is not extracted unasked.
 *
 *     const read = await readSurface(file.stream(), { fileName: file.name });
 *     if (read.success) await mesher.fillSurface(read.value);
 */
export function readSurface(source: ByteSource, options: ReadFileOptions): Promise<ReadResult<Mesh>> {
  return asResult(async () =>
    inSteps(surfaceOf(await readAny(source, options, ["surface"])), options.signal),
  );
}

/** Reads the tetrahedra of a file, with the nodes they use and the values at these nodes. */
export function readVolume(source: ByteSource, options: ReadFileOptions): Promise<ReadResult<Mesh>> {
  return asResult(async () => inSteps(volumeOf(await readAny(source, options, ["volume"])), options.signal));
}

/** Reads all triangles and tetrahedra of a file without welding. */
export function readMesh(source: ByteSource, options: ReadFileOptions): Promise<ReadResult<Mesh>> {
  return asResult(() => readAny(source, options, ["surface", "volume"]));
}

/**
 * Writes a mesh in the format selected by `fileName`. Returns one or several files, with notes about content that
 * the format cannot store. Formats for surfaces get the triangles only. Works in slices of a few milliseconds.
 *
 * Rejects with a `MesherError` of code `invalid-input` and one of these diagnostics: `unknown-format` if no
 * writable format has this extension (see `formatOf`); `invalid-arrays` if lengths or indices are inconsistent;
 * `invalid-mesh` if the format is for solvers and the elements do not fit together; `invalid-option` if the format does not
 * store elements of the wanted order.
 */
export async function writeMesh(
  mesh: Mesh,
  fileName: string,
  options: WriteFileOptions = {},
): Promise<readonly WrittenFile[]> {
  const { files, notes } = await streamMesh(mesh, fileName, options);
  const written: Omit<WrittenFile, "notes">[] = [];
  for (const { fileName: name, pieces } of files) {
    const all: Uint8Array[] = [];
    for await (const piece of pieces) all.push(piece);
    written.push({ fileName: name, bytes: joined(all) });
  }
  return written.map((file, f) => ({ ...file, notes: f === 0 ? notes : [] }));
}

/**
 * As `writeMesh`, but the files are made while you read them: beside the mesh, only a few pieces are in memory. VTU is kept
 * compressed until its last array is made, as its head states where each array begins. Writes in slices of a few
 * milliseconds. `onProgress` and `signal` work while the pieces are read.
 *
 *     const { files } = await streamMesh(mesh, "part.msh");
 *     for (const { pieces } of files) for await (const piece of pieces) await writable.write(piece);
 */
export function streamMesh(
  mesh: Mesh,
  fileName: string,
  options: WriteFileOptions = {},
): Promise<StreamedMesh> {
  return streamedMesh(mesh, fileName, options, memorySpool);
}

/** As `streamMesh`; `createSpool` decides where the arrays of VTU are kept. */
export async function streamedMesh(
  mesh: Mesh,
  fileName: string,
  options: WriteFileOptions,
  createSpool: () => Spool,
): Promise<StreamedMesh> {
  checkArgument("options", options, writeOptions);
  const unknown = unknownOption(options, WRITE_OPTIONS);
  if (unknown !== undefined) {
    refuse([packageDiagnostic("invalid-argument", unknown.message, unknown.remedy)]);
  }
  const { signal } = options;
  throwIfCancelled(signal);
  const format = typeof fileName === "string" ? formatOf(fileName) : undefined;
  const { write, passes = DEFAULT_PASSES } = (await format?.load()) ?? {};
  if (write === undefined) {
    const message = `no format that can be written has the extension of ${shown(fileName)}`;
    const known = [...extensionsFor("write", "volume"), ...extensionsFor("write", "surface")];
    const remedy = `Use a name that ends in one of ${known.join(", ")}.`;
    refuse([packageDiagnostic("unknown-format", message, remedy)]);
    return { files: [], notes: [] };
  }
  const { elementOrder = 1, blocks } = options;
  if (blocks !== undefined) {
    const code = await format?.load();
    if (code?.writeBlocks === undefined || elementOrder === 2) refuse([noBlocks(fileName)]);
    refuse(await inSteps(checkFileMesh(mesh), signal));
    return streamedBlocks(code?.writeBlocks, { mesh, blocks }, fileName, options, createSpool);
  }
  if (elementOrder === 2 && format !== undefined) refuseLinear(format);
  refuse(await inSteps(checkFileMesh(mesh), signal));
  const written = elementOrder === 2 ? await inSteps(withMidNodes(mesh), signal) : mesh;
  const notes: Diagnostic[] = [];
  const note = (message: string) => notes.push(packageDiagnostic("left-out", message, "", "information"));
  if (format?.writable.includes("volume") === false) noteLostRegions(mesh, note);
  const rows = (written.points.length + mesh.triangles.length) / 3 + mesh.tetrahedra.length / 4;
  const files = write(written, fileName, note, createSpool);
  return { files: streamed(files, options, (passes * rows) / STEP), notes };
}

function noBlocks(fileName: string): Diagnostic {
  const known = FILE_FORMATS.filter(({ id }) => ["vtu", "gmsh"].includes(id)).flatMap(
    ({ extensions }) => extensions,
  );
  const message = `${shown(fileName)} cannot be written from blocks of elements`;
  const remedy = `Use a name that ends in one of ${known.join(", ")}, and the order 1; or mesh without inBlocks.`;
  return invalidOption("blocks", message, remedy);
}

/** As `streamed`, of elements that are read while the file is written. */
function streamedBlocks(
  write: BlockWriter | undefined,
  mesh: BlockedMesh,
  fileName: string,
  { signal, onProgress }: WriteFileOptions,
  createSpool: () => Spool,
): StreamedMesh {
  const notes: Diagnostic[] = [];
  const note = (message: string) => notes.push(packageDiagnostic("left-out", message, "", "information"));
  const { blocks } = mesh;
  const total = blocks.nodes + blocks.tetrahedra;
  let [read, bytes] = [0, 0];
  /** Most of the work follows from what is read; files come late or early. */
  const watched =
    <Values>(readBlock: (first: number, count: number) => Promise<Values>) =>
    (first: number, count: number) => {
      throwIfCancelled(signal);
      read += count;
      onProgress?.({ fraction: Math.min(MAX_ESTIMATE, read / total), bytes });
      return readBlock(first, count);
    };
  const own = {
    ...blocks,
    readPoints: watched(blocks.readPoints),
    readTetrahedra: watched(blocks.readTetrahedra),
  };
  const pieces = async function* (): AsyncGenerator<Uint8Array, void> {
    const yielder = new Yielder(signal);
    for await (const part of write?.({ ...mesh, blocks: own }, note, createSpool) ?? []) {
      for (const piece of piecesIn([part])) {
        bytes += piece.length;
        for (let at = 0; at < piece.length; at += PIECE_BYTES) yield piece.subarray(at, at + PIECE_BYTES);
        if (yielder.isDue) await yielder.yield();
      }
    }
    onProgress?.({ fraction: 1, bytes });
  };
  return { files: [{ fileName, pieces: pieces() }], notes };
}

/** Rejects a format that stores linear elements only. */
function refuseLinear({ name, hasSecondOrder }: FileFormat): void {
  if (hasSecondOrder === true) return;
  const known = FILE_FORMATS.filter((format) => format.hasSecondOrder).flatMap(
    ({ extensions }) => extensions,
  );
  const message = `${name} files cannot be written with second-order elements`;
  const remedy = `Use a name that ends in one of ${known.join(", ")}, or the order 1.`;
  refuse([invalidOption("elementOrder", message, remedy)]);
}

/** Number of passes over nodes and elements for writers that do not state it. */
const DEFAULT_PASSES = 4;
/** Largest fraction reported before the end, as the estimate may be too low. */
const MAX_ESTIMATE = 0.99;

/** Most bytes of a piece: a program that copies each needs no more memory. */
const PIECE_BYTES = 1 << 20;

/** Returns files whose bytes are generated while they are read, in about `expected` pieces, with pauses between them. */
function streamed(
  files: readonly FileParts[],
  { signal, onProgress }: WriteFileOptions,
  expected: number,
): StreamedFile[] {
  const yielder = new Yielder(signal);
  let [steps, bytes] = [0, 0];
  const piecesOf = async function* (
    parts: Iterable<Part>,
    isLast: boolean,
  ): AsyncGenerator<Uint8Array, void> {
    for (const piece of piecesIn(parts)) {
      steps++;
      bytes += piece.length;
      for (let at = 0; at < piece.length; at += PIECE_BYTES) yield piece.subarray(at, at + PIECE_BYTES);
      if (!yielder.isDue) continue;
      onProgress?.({ fraction: Math.min(MAX_ESTIMATE, steps / expected), bytes });
      await yielder.yield();
    }
    if (isLast) onProgress?.({ fraction: 1, bytes });
  };
  return files.map(({ fileName, parts }, f) => ({
    fileName,
    pieces: piecesOf(parts, f === files.length - 1),
  }));
}

async function readAny(
  source: ByteSource,
  options: ReadFileOptions,
  contents: readonly Contents[],
): Promise<Mesh> {
  checkSource(source);
  const { fileName, signal, size, openOther = () => Promise.resolve(undefined) } = checkedOptions(options);
  throwIfCancelled(signal);
  const format = formatOf(fileName);
  if (!format?.readable.some((held) => contents.includes(held)))
    throw unknownFormat(fileName, format, contents);
  const { read, arrival = 1 } = await format.load();
  if (read === undefined) throw unknownFormat(fileName, format, contents);
  const head = new FileHead();
  try {
    const { onProgress } = options;
    let arrived = 0;
    const tell = onProgress && ((share: number) => onProgress(Math.floor(share * arrived)));
    const onArrival = (bytes: number) => {
      arrived = bytes;
      tell?.(arrival);
    };
    const onWork = (fraction: number) => tell?.(arrival + (1 - arrival) * fraction);
    const watched = watcher({ signal, onProgress: onProgress && onArrival });
    const opened: OpenOther = async (name) => {
      const other = await untilCancelled(() => checkedOpening(openOther)(name), signal);
      return other && watched(other);
    };
    const sizeInFile = size === undefined ? undefined : lengthInFile(size, options);
    const context = { fileName, size: sizeInFile, openOther: opened, signal, onWork };
    return await inSteps(inUnits(await read(head.of(watched(source)), context), options), signal);
  } catch (failure) {
    throw failureIn(fileName, head.explained(asTooLarge(failure), format.name));
  }
}

const WATCH_OPTIONS = ["onProgress", "signal"] as const;
const WRITE_OPTIONS = [...WATCH_OPTIONS, "elementOrder", "blocks"] satisfies (keyof WriteFileOptions)[];
const READ_OPTIONS = [
  "fileName",
  "size",
  "openOther",
  "scale",
  "units",
  "fileUnits",
  ...WATCH_OPTIONS,
] satisfies (keyof ReadFileOptions)[];

/** Reports an unknown option, which would otherwise be ignored silently. */
function unknownOption(
  options: object,
  known: readonly string[],
): { readonly message: string; readonly remedy: string } | undefined {
  const unknown = Object.keys(options).find((name) => !known.includes(name));
  if (unknown === undefined) return undefined;
  return { message: `unknown option "${unknown}"`, remedy: remedyOf(known) };
}

function remedyOf(known: readonly string[]): string {
  return `Use only these options: ${known.join(", ")}.`;
}

const unit = v.optional(v.picklist(LENGTH_UNITS));
const readOptions = v.object({
  size: v.optional(v.pipe(v.number(), v.finite(), v.gtValue(0))),
  openOther: v.optional(v.function()),
  scale: v.optional(v.pipe(v.number(), v.minValue(MIN_LENGTH), v.maxValue(MAX_LENGTH))),
  units: unit,
  fileUnits: unit,
  ...watch,
});
const blocks = v.optional(
  v.object({
    nodes: v.number(),
    tetrahedra: v.number(),
    regionRuns: v.array(v.object({ region: v.number(), count: v.number() })),
    readPoints: v.function(),
    readTetrahedra: v.function(),
  }),
);
const writeOptions = v.object({ ...watch, elementOrder: v.optional(v.picklist([1, 2])), blocks });

function checkedOptions(options: ReadFileOptions): ReadFileOptions {
  const { fileName } = (options as ReadFileOptions | null | undefined) ?? {};
  if (typeof fileName === "string") {
    const unknown = unknownOption(options, READ_OPTIONS);
    if (unknown !== undefined) throw new ReadFailure({ code: "invalid-argument", ...unknown });
    const problem = problemIn(readOptions, options);
    if (problem === undefined) return options;
    const message = `options.${problem.path} is invalid: ${problem.message}`;
    throw new ReadFailure({ code: "invalid-argument", message, remedy: remedyOf(READ_OPTIONS) });
  }
  throw new ReadFailure({
    code: "invalid-argument",
    message: "options.fileName is missing; its extension selects the format",
    remedy: 'Pass a file name, for example { fileName: "part.stl" }.',
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
      ? `no known format has the extension of "${fileName}"`
      : `${format.name} files cannot be read as ${what === "mesh" ? "meshes" : `${what}s`}`;
  const known = [...new Set(contents.flatMap((held) => extensionsFor("read", held)))];
  const remedy = `Use a file whose name ends in one of ${known.join(", ")}.`;
  return new ReadFailure({ code: "unknown-format", message, remedy, fileName });
}

/** Checks what `openOther` returns, because callers without type checks may return anything. */
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
