/**
 * Reads and writes files by path, in Node.
 *
 *     import { readSurfaceFile, writeMeshFile } from "tetrafront/node";
 */
import { randomUUID } from "node:crypto";
import { createReadStream } from "node:fs";
import { readFile, realpath, rename, rm, stat, writeFile } from "node:fs/promises";
import path from "node:path";
import * as v from "valibot";
import {
  type ReadFileOptions,
  readMesh,
  readSurface,
  readVolume,
  streamedMesh,
  type WriteFileOptions,
} from "./api/mesh-files.js";
import { meshFile as meshSource, type MeshedFile, type MeshFileOptions, unopened } from "./api/mesh-file.js";
import { checkArgument } from "./calls/argument-checks.js";
import { printable } from "./diagnostics/package-diagnostic.js";
import type { ReadResult } from "./diagnostics/read-error.js";
import type { RunControl } from "./engine/control.js";
import type { ByteSource } from "./formats/byte-source.js";
import type { WrittenFile } from "./formats/file-format.js";
import { fileSpool } from "./formats/file-spool.js";
import type { Mesh } from "./mesh/mesh.js";
import { readProject, writeProject } from "./project/project.js";
import type { Project } from "./project/project-types.js";

/** Options for reading a file by path. */
export type ReadPathOptions = Omit<ReadFileOptions, "fileName" | "openOther">;

/**
 * As `readSurface`, for the file at a path. Other files of its format are read from the same folder. If the file cannot
 * be opened, the result is an error of code `unreadable-file`.
 *
 *     const read = await readSurfaceFile("part.stl");
 *     if (!read.success) throw new Error(read.errors[0].message);
 */
export function readSurfaceFile(file: string, options?: ReadPathOptions): Promise<ReadResult<Mesh>> {
  return readFrom(readSurface, file, options);
}

/** As `readVolume`, for the file at a path; see `readSurfaceFile`. */
export function readVolumeFile(file: string, options?: ReadPathOptions): Promise<ReadResult<Mesh>> {
  return readFrom(readVolume, file, options);
}

/** As `readMesh`, for the file at a path; see `readSurfaceFile`. */
export function readMeshFile(file: string, options?: ReadPathOptions): Promise<ReadResult<Mesh>> {
  return readFrom(readMesh, file, options);
}

/** As `readProject`, for the file at a path; see `readSurfaceFile`. */
export async function readProjectFile(file: string): Promise<ReadResult<Project>> {
  checkArgument("file", file, v.string());
  try {
    return readProject(await readFile(file, "utf8"));
  } catch (failure) {
    return unreadable(file, failure);
  }
}

/**
 * As `writeMesh`, to the file at a path, which is replaced. Formats with several files write the others to the same
 * folder. Beside the mesh, a few megabytes are in memory. Resolves to the names of the written files, and what they could not
 * store. Rejects with the error of Node if writing fails.
 */
export async function writeMeshFile(
  mesh: Mesh,
  file: string,
  options: WriteFileOptions = {},
): Promise<readonly Omit<WrittenFile, "bytes">[]> {
  checkArgument("file", file, v.string());
  const folder = path.dirname(file);
  const { files, notes } = await streamedMesh(mesh, path.basename(file), options, () => fileSpool(folder));
  for (const { fileName, pieces } of files) await replaceFile(path.join(folder, fileName), pieces);
  return files.map(({ fileName }, f) => ({ fileName, notes: f === 0 ? notes : [] }));
}

/** Writes a file by another name and renames it, so that a failure keeps the file that was there. */
async function replaceFile(file: string, content: AsyncIterable<Uint8Array>): Promise<void> {
  const found = await stat(file).catch(() => undefined);
  // Devices and pipes must not be replaced.
  if (found !== undefined && !found.isFile()) return writeFile(file, content);
  const target = found === undefined ? file : await realpath(file);
  const temporary = path.join(path.dirname(target), `.${randomUUID()}.part`);
  try {
    await writeFile(temporary, content, { flag: "wx", ...(found && { mode: found.mode }) });
    await rename(temporary, target);
  } finally {
    await rm(temporary, { force: true });
  }
}

/** As `writeProject`, to the file at a path, which is replaced. Rejects with the error of Node if writing fails. */
export async function writeProjectFile(project: Project, file: string): Promise<void> {
  checkArgument("file", file, v.string());
  await writeFile(file, writeProject(project));
}

/** Options for meshing a file by its path. */
export type MeshPathOptions = Omit<MeshFileOptions, "fileName" | "openOther">;

/**
 * As `meshFile` of the package, for the file at a path. Other files of its format are read from the same folder.
 *
 *     const made = await meshFile("part.stl");
 *     if (made.success) await writeMeshFile(made.mesh, "part.vtu");
 *     else console.error(made.message);
 */
export async function meshFile(
  file: string,
  options: MeshPathOptions = {},
  control?: RunControl,
): Promise<MeshedFile> {
  checkArgument("file", file, v.string());
  const openOther = async (name: string) => openBeside(file, name);
  try {
    return await meshSource(piecesOf(file), { ...options, fileName: file, openOther }, control);
  } catch (failure) {
    return unopened(unreadable(file, failure));
  }
}

type ReadFailed = Extract<ReadResult<never>, { readonly success: false }>;

type Read<T> = (source: ByteSource, options: ReadFileOptions) => Promise<ReadResult<T>>;

async function readFrom<T>(
  read: Read<T>,
  file: string,
  options: ReadPathOptions = {},
): Promise<ReadResult<T>> {
  checkArgument("file", file, v.string());
  try {
    return await read(piecesOf(file), {
      ...options,
      fileName: file,
      openOther: async (name) => openBeside(file, name),
    });
  } catch (failure) {
    return unreadable(file, failure);
  }
}

/** Yields the bytes of a file; opens it only when they are read. */
async function* piecesOf(file: string): AsyncGenerator<Uint8Array, void> {
  for await (const piece of createReadStream(file)) yield piece as Buffer;
}

async function openBeside(file: string, name: string): Promise<ByteSource | undefined> {
  const other = path.join(path.dirname(file), path.basename(name));
  const found = await stat(other).catch(() => undefined);
  return found?.isFile() === true ? piecesOf(other) : undefined;
}

/** Returns the error of the file system as a read error; throws any other failure. */
function unreadable(fileName: string, failure: unknown): ReadFailed {
  if (!(failure instanceof Error) || !("syscall" in failure)) throw failure;
  const message = `the file cannot be read: ${printable(failure.message)}`;
  const remedy = "Check the path and the permissions of the file.";
  return { success: false, errors: [{ code: "unreadable-file", message, remedy, fileName }] };
}
