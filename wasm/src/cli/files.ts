/** Files of the command line: every failure becomes one line with a remedy. */
import { randomUUID } from "node:crypto";
import { constants, createReadStream, fstatSync, rmSync, writeFileSync, type Stats } from "node:fs";
import { access, lstat, open, readFile, realpath, rename, rm, stat } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { isatty } from "node:tty";
import { MesherError } from "../diagnostics/mesher-error.js";
import { allBytes } from "../formats/byte-source.js";
import { type EndingSignal, offEndingSignals, onEndingSignals } from "./signals.js";

/** Failure of a file operation; ends the command with a message. */
export class FileError extends Error {
  constructor(
    readonly file: string,
    message: string,
    readonly remedy: string,
  ) {
    super(message);
  }
}

/** Failure to write a file after its content was made. */
export class WriteError extends FileError {}

/** Name that stands for standard input or standard output. */
export const STANDARD_STREAM = "-";

/** Returns the bytes of a file. Throws a FileError. */
export async function readInput(file: string): Promise<Uint8Array> {
  if (file === STANDARD_STREAM) return allBytes(piecesOfInput(file));
  try {
    return await readFile(file);
  } catch (failure) {
    throw inputError(file, failure);
  }
}

/** Yields the bytes of a file piece by piece. Throws a FileError while reading. */
export async function* piecesOfInput(file: string): AsyncGenerator<Uint8Array, void> {
  const stream =
    file === STANDARD_STREAM ? process.stdin : createReadStream(file, { highWaterMark: PIECE_BYTES });
  try {
    for await (const piece of stream) yield piece as Buffer;
  } catch (failure) {
    throw codeOf(failure) === "" ? failure : inputError(file, failure);
  }
}

/** Large enough for few system calls, small enough for little memory. */
const PIECE_BYTES = 1 << 20;

/** Opens the file of this name next to another, for formats of several files; undefined if there is none. */
export async function openBeside(file: string, name: string): Promise<AsyncIterable<Uint8Array> | undefined> {
  const other = path.join(path.dirname(file), path.basename(name));
  return (await statOf(other))?.isFile() === true ? piecesOfInput(other) : undefined;
}

/** Error for an empty name, which scripts pass for an unset variable. */
export function emptyName(): FileError {
  return new FileError('""', "the file name is empty", "Use the name of a file, or - for a stream.");
}

/** Throws a FileError if there is no such file. */
export async function checkInput(file: string): Promise<void> {
  if (file === STANDARD_STREAM) return;
  if (file === "") throw emptyName();
  try {
    if ((await stat(file)).isDirectory()) throw folderError(file);
  } catch (failure) {
    throw failure instanceof FileError ? failure : inputError(file, failure);
  }
}

function folderError(folder: string): FileError {
  const pattern = `'${path.join(folder, "*.stl")}'`;
  const remedy = `Use a file in it; commands for several files also accept patterns such as ${pattern}.`;
  return new FileError(folder, "this is a folder", remedy);
}

function inputError(file: string, failure: unknown): FileError {
  switch (codeOf(failure)) {
    case "ENOENT":
    case "ENOTDIR":
      return new FileError(file, "there is no such file", "Check the path.");
    case "EISDIR":
      return folderError(file);
    case "EACCES":
    case "EPERM":
      return new FileError(file, "permission to read the file is denied", "Change its permissions.");
    default:
      return new FileError(
        file,
        `the file cannot be read (${reasonOf(failure)})`,
        "Try another copy of the file.",
      );
  }
}

/** Throws a FileError if the name of an output is empty or a folder. */
export async function refuseFolder(file: string): Promise<void> {
  if (file === "") throw emptyName();
  if (file === STANDARD_STREAM || (await statOf(file))?.isDirectory() !== true) return;
  throw new FileError(file, "this is a folder", "Use the name of a file in it.");
}

/** Checks before hours of meshing whether a file can be written. Throws a FileError. */
export async function checkOutput(file: string): Promise<void> {
  if (file === STANDARD_STREAM) return;
  await refuseFolder(file);
  const found = await statOf(file);
  const folder = path.dirname(file);
  const folderStatus = await statOf(folder);
  if (folderStatus?.isDirectory() !== true) {
    throw new FileError(file, `the folder ${folder} does not exist`, "Create it, or choose another.");
  }
  if (found === undefined || found.isFile()) return tryFolder(file, found !== undefined);
  const mayWrite = await access(file, constants.W_OK).then(
    () => true,
    () => false,
  );
  if (!mayWrite) {
    throw new FileError(
      file,
      "permission to write is denied",
      "Choose another file, or change its permissions.",
    );
  }
}

/** Creates and removes the temporary file that writeOutput() would create first: permissions alone do not decide. */
async function tryFolder(file: string, exists: boolean): Promise<void> {
  try {
    const temporary = temporaryFor(exists ? await realpath(file) : file);
    await writeTo(temporary, "", "wx");
    await rm(temporary, { force: true });
    if (!exists) await tryName(file);
  } catch (failure) {
    throw new FileError(
      file,
      `the file cannot be written (${reasonOf(failure)})`,
      "Choose another file, or change the permissions of its folder.",
    );
  }
}

/** Checks the file's own name, which may be too long or not permitted by the file system. */
async function tryName(file: string): Promise<void> {
  try {
    await lstat(file);
  } catch (failure) {
    if (codeOf(failure) !== "ENOENT") throw failure;
  }
}

/** Returns a unique name, because process ids repeat in containers; it is short even if the file's name is long. */
function temporaryFor(target: string): string {
  return path.join(path.dirname(target), `.${randomUUID()}.part`);
}

/** Content of an output: all of it, or pieces that are made while they are written. */
export type Content = string | Uint8Array | AsyncIterable<Uint8Array>;

/** Returns the folder for temporary files of an output: its own, unless the output is a stream or a device. */
export async function temporaryFolderFor(file: string): Promise<string> {
  if (file === STANDARD_STREAM) return tmpdir();
  const found = await statOf(file);
  return found === undefined || found.isFile() ? path.dirname(file) : tmpdir();
}

/**
 * Writes a file so that no program ever sees a part of it: to a temporary file next to it, which is then renamed. A
 * replaced file keeps its permissions. Devices and pipes must not be replaced and are written to directly. Throws a
 * FileError; what the making of a piece throws is thrown as it is.
 */
export async function writeOutput(file: string, content: Content): Promise<void> {
  if (file === STANDARD_STREAM) return writeToStandardOutput(content);
  const found = await statOf(file);
  try {
    if (found !== undefined && !found.isFile()) return await writeTo(file, content, "w");
    // Resolve links, or the link would be replaced.
    const target = found === undefined ? file : await realpath(file);
    const mode = found === undefined ? undefined : found.mode & PERMISSIONS;
    await unlessInterrupted(temporaryFor(target), async (temporary) => {
      await writeTo(temporary, content, "wx", mode);
      await rename(temporary, target);
    });
  } catch (failure) {
    if (failure instanceof MesherError) throw failure;
    throw new WriteError(
      file,
      `the file cannot be written (${reasonOf(failure)})`,
      "Choose another folder, or free space on the disk.",
    );
  }
}

/** Bits of a file's mode without those of its type. */
const PERMISSIONS = 0o7777;

/** Temporary files that are being written. */
const temporaries = new Set<string>();

/** Removes the temporary file when the work is done, has failed or is ended by a signal. */
async function unlessInterrupted(
  temporary: string,
  work: (temporary: string) => Promise<void>,
): Promise<void> {
  if (temporaries.size === 0) onEndingSignals(endBySignal);
  temporaries.add(temporary);
  try {
    await work(temporary);
  } finally {
    await rm(temporary, { force: true });
    temporaries.delete(temporary);
    if (temporaries.size === 0) offEndingSignals(endBySignal);
  }
}

/**
 * Removes the temporary files and ends the process by the signal. If another listener is present, that listener
 * decides.
 */
function endBySignal(signal: EndingSignal): void {
  if (process.listenerCount(signal) > 1) return;
  for (const temporary of temporaries) rmSync(temporary, { force: true });
  process.off(signal, endBySignal);
  process.kill(process.pid, signal);
}

/** Thrown if the reader of standard output has closed the pipe; no message can reach it. */
export class ClosedPipe extends Error {}

/** Writes all of the content. Throws a ClosedPipe, or a WriteError if writing fails for another reason. */
export async function writeToStandardOutput(content: Content): Promise<void> {
  try {
    const isAtOnce = isSynchronous(process.stdout.fd);
    for await (const piece of piecesOf(content)) {
      if (isAtOnce) writeFileSync(process.stdout.fd, piece);
      else await written(process.stdout, piece);
    }
  } catch (failure) {
    if (failure instanceof MesherError) throw failure;
    if (codeOf(failure) === "EPIPE") throw new ClosedPipe();
    throw new WriteError(
      "standard output",
      `writing failed (${reasonOf(failure)})`,
      "Free space on the disk, or let the next program read all of the output.",
    );
  }
}

/**
 * Returns whether Node writes to this descriptor synchronously, as to files and devices other than terminals. Its stream
 * then ignores a write that stores a part of the content only, as the last one on a full disk does.
 */
function isSynchronous(descriptor: number): boolean {
  const found = fstatSync(descriptor);
  return found.isFile() || (found.isCharacterDevice() && !isatty(descriptor));
}

function piecesOf(content: Content): AsyncIterable<Uint8Array> | readonly (string | Uint8Array)[] {
  return typeof content === "string" || content instanceof Uint8Array ? [content] : content;
}

function written(stream: NodeJS.WritableStream, content: string | Uint8Array): Promise<void> {
  return new Promise((resolve, reject) => {
    stream.write(content, (failure) => (failure == null ? resolve() : reject(failure)));
  });
}

/** `mode`: permissions of the new file, if they are not the usual ones. */
async function writeTo(file: string, content: Content, flags: "w" | "wx", mode?: number): Promise<void> {
  const handle = await open(file, flags);
  try {
    if (mode !== undefined) await handle.chmod(mode);
    for await (const piece of piecesOf(content)) await handle.writeFile(piece);
  } finally {
    await handle.close();
  }
}

async function statOf(file: string): Promise<Stats | undefined> {
  return stat(file).catch(() => undefined);
}

/**
 * Returns an identity that is equal for all names of one file, whether or not the file exists; undefined for
 * devices and pipes, which are never replaced.
 */
export async function fileIdentity(file: string): Promise<string | undefined> {
  if (file === STANDARD_STREAM) return STANDARD_STREAM;
  const found = await statOf(file);
  if (found !== undefined) return found.isFile() ? `${found.dev} ${found.ino}` : undefined;
  const folder = await realpath(path.dirname(file)).catch(() => path.resolve(path.dirname(file)));
  return path.join(folder, path.basename(file));
}

function codeOf(failure: unknown): string {
  return failure instanceof Error && "code" in failure ? String(failure.code) : "";
}

function reasonOf(failure: unknown): string {
  return codeOf(failure) || String(failure);
}
