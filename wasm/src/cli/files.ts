/** Files as the command line meets them: every way to fail gets one line with a remedy. */
import { randomUUID } from "node:crypto";
import { constants, createReadStream, rmSync } from "node:fs";
import { access, lstat, open, readFile, realpath, rename, rm, stat } from "node:fs/promises";
import path from "node:path";

import { allBytes } from "../formats/byte-source.js";

/** A failure of a file, told to the user and ending the command. */
export class FileProblem extends Error {
  constructor(
    readonly file: string,
    message: string,
    readonly remedy: string,
  ) {
    super(message);
  }
}

/** In place of a file's name: standard input, or standard output. */
export const STANDARD_STREAM = "-";

/** The bytes of a file. Throws a FileProblem. */
export async function readInput(file: string): Promise<Uint8Array> {
  if (file === STANDARD_STREAM) return allBytes(piecesOfInput(file));
  try {
    return await readFile(file);
  } catch (failure) {
    throw inputProblem(file, failure);
  }
}

/** The bytes of a file, piece by piece. Throws a FileProblem while they are read. */
export async function* piecesOfInput(file: string): AsyncGenerator<Uint8Array, void> {
  const stream =
    file === STANDARD_STREAM ? process.stdin : createReadStream(file, { highWaterMark: PIECE_BYTES });
  try {
    for await (const piece of stream) yield piece as Buffer;
  } catch (failure) {
    throw codeOf(failure) === "" ? failure : inputProblem(file, failure);
  }
}

/** Few calls of the system, little memory. */
const PIECE_BYTES = 1 << 20;

/** The file of this name beside another, for formats of several files; undefined where there is none. */
export async function openBeside(file: string, name: string): Promise<AsyncIterable<Uint8Array> | undefined> {
  const other = path.join(path.dirname(file), path.basename(name));
  return (await statOf(other))?.isFile() === true ? piecesOfInput(other) : undefined;
}

/** An empty word, as scripts make of a variable that is not set. */
export function nameless(): FileProblem {
  return new FileProblem('""', "this is no name of a file", "Give one, or - for a stream.");
}

/** Whether there is a file to read at all. Throws a FileProblem. */
export async function checkInput(file: string): Promise<void> {
  if (file === STANDARD_STREAM) return;
  if (file === "") throw nameless();
  try {
    if ((await stat(file)).isDirectory()) throw folderProblem(file);
  } catch (failure) {
    throw failure instanceof FileProblem ? failure : inputProblem(file, failure);
  }
}

function folderProblem(folder: string): FileProblem {
  const several = `what takes several files takes a pattern too, such as '${path.join(folder, "*.stl")}'`;
  return new FileProblem(folder, "this is a folder", `Give a file in it; ${several}.`);
}

function inputProblem(file: string, failure: unknown): FileProblem {
  switch (codeOf(failure)) {
    case "ENOENT":
    case "ENOTDIR":
      return new FileProblem(file, "there is no such file", "Check the path.");
    case "EISDIR":
      return folderProblem(file);
    case "EACCES":
    case "EPERM":
      return new FileProblem(file, "the file may not be read", "Change its permissions.");
    default:
      return new FileProblem(
        file,
        `the file cannot be read (${reasonOf(failure)})`,
        "Try another copy of it.",
      );
  }
}

/** Throws a FileProblem where nothing, or a folder, is given as a file to write. */
export async function refuseFolder(file: string): Promise<void> {
  if (file === "") throw nameless();
  if (file === STANDARD_STREAM || (await statOf(file))?.isDirectory() !== true) return;
  throw new FileProblem(file, "this is a folder", "Give the name of a file in it.");
}

/** Finds out before hours of meshing whether a file can be written. Throws a FileProblem. */
export async function checkOutput(file: string): Promise<void> {
  if (file === STANDARD_STREAM) return;
  await refuseFolder(file);
  const found = await statOf(file);
  const folder = path.dirname(file);
  const place = await statOf(folder);
  if (place?.isDirectory() !== true) {
    throw new FileProblem(file, `there is no folder ${folder} to write to`, "Create it, or choose another.");
  }
  if (found === undefined || found.isFile()) return tryPlace(file, found !== undefined);
  const mayWrite = await access(file, constants.W_OK).then(
    () => true,
    () => false,
  );
  if (!mayWrite) {
    throw new FileProblem(
      file,
      "this place may not be written to",
      "Choose another, or change its permissions.",
    );
  }
}

/** Makes the file that writeOutput() would make first, and removes it: permissions do not tell all. */
async function tryPlace(file: string, exists: boolean): Promise<void> {
  try {
    const temporary = temporaryFor(exists ? await realpath(file) : file);
    await writeTo(temporary, "", "wx");
    await rm(temporary, { force: true });
    if (!exists) await tryName(file);
  } catch (failure) {
    throw new FileProblem(
      file,
      `this place may not be written to (${reasonOf(failure)})`,
      "Choose another, or change its permissions.",
    );
  }
}

/** The file's own name may be too long, or one that the file system does not take. */
async function tryName(file: string): Promise<void> {
  try {
    await lstat(file);
  } catch (failure) {
    if (codeOf(failure) !== "ENOENT") throw failure;
  }
}

/** Of a name that no run had before, for in a container all have one number; short, however long the file's is. */
function temporaryFor(target: string): string {
  return path.join(path.dirname(target), `.${randomUUID()}.part`);
}

/**
 * Writes a file so that nobody ever sees half of it: beside it first, then renamed. Devices and pipes,
 * which must not be replaced, are written to directly. Throws a FileProblem.
 */
export async function writeOutput(file: string, content: string | Uint8Array): Promise<void> {
  if (file === STANDARD_STREAM) return writeToStandardOutput(content);
  const found = await statOf(file);
  try {
    if (found !== undefined && !found.isFile()) return await writeTo(file, content, "w");
    // Through a link to the file itself, or the link would be replaced.
    const target = found === undefined ? file : await realpath(file);
    await unlessInterrupted(temporaryFor(target), async (temporary) => {
      await writeTo(temporary, content, "wx");
      await rename(temporary, target);
    });
  } catch (failure) {
    throw new FileProblem(file, `the file cannot be written (${reasonOf(failure)})`, "Choose another place.");
  }
}

/** Those that are being written now. */
const temporaries = new Set<string>();

/** Leaves no temporary file behind, whether the work is done, has failed or is ended by a signal. */
async function unlessInterrupted(
  temporary: string,
  work: (temporary: string) => Promise<void>,
): Promise<void> {
  if (temporaries.size === 0) process.on("SIGINT", endWithout).on("SIGTERM", endWithout);
  temporaries.add(temporary);
  try {
    await work(temporary);
  } finally {
    await rm(temporary, { force: true });
    temporaries.delete(temporary);
    if (temporaries.size === 0) process.off("SIGINT", endWithout).off("SIGTERM", endWithout);
  }
}

/** The signal ends the process as it would have; where somebody else hears it, it is for that one to say when. */
function endWithout(signal: NodeJS.Signals): void {
  if (process.listenerCount(signal) > 1) return;
  for (const temporary of temporaries) rmSync(temporary, { force: true });
  process.off(signal, endWithout);
  process.kill(process.pid, signal);
}

/** Raised where the reader of standard output has gone: nobody is left to be told anything. */
export class ClosedPipe extends Error {}

/** Throws a ClosedPipe, or a FileProblem where it cannot be written to for another reason. */
export function writeToStandardOutput(content: string | Uint8Array): Promise<void> {
  return new Promise((resolve, reject) => {
    process.stdout.write(content, (failure) => {
      if (failure == null) return resolve();
      if (codeOf(failure) === "EPIPE") return reject(new ClosedPipe());
      reject(
        new FileProblem(
          "standard output",
          `it cannot be written to (${reasonOf(failure)})`,
          "Let the next program read it all.",
        ),
      );
    });
  });
}

async function writeTo(file: string, content: string | Uint8Array, flags: "w" | "wx"): Promise<void> {
  const handle = await open(file, flags);
  try {
    await handle.writeFile(content);
  } finally {
    await handle.close();
  }
}

async function statOf(file: string): Promise<Awaited<ReturnType<typeof stat>> | undefined> {
  return stat(file).catch(() => undefined);
}

/**
 * The same for all names of one place, whether or not a file is there yet; undefined for devices and pipes,
 * where nothing is replaced.
 */
export async function placeOf(file: string): Promise<string | undefined> {
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
