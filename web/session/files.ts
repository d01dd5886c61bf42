import type { Project } from "tetrafront/project";
import { readProjectBlob, writeProjectBlob } from "../workers/project-files";
import { readSurfaceFile, type FileContent, type OpenedMesh } from "../workers/surface-files";
import { strings } from "../strings";
import type { ProjectFile } from "./document-store";
import { keepWhatReads } from "./offline";

/** Result of opening a file. `cancelled` means that the user closed the dialog. */
export type OpenResult =
  | {
      readonly kind: "opened";
      readonly fileName: string;
      readonly project: Project;
      /** Null if the browser does not let the app write to the file. */
      readonly file: ProjectFile | null;
    }
  | { readonly kind: "surface"; readonly name: string; readonly read: FileContent }
  | {
      readonly kind: "mesh";
      readonly name: string;
      readonly fileName: string;
      readonly read: FileContent;
      readonly mesh: OpenedMesh;
    }
  | { readonly kind: "cancelled" }
  | FailedOpening;

export interface FailedOpening {
  readonly kind: "failed";
  readonly fileName: string;
  readonly reasons: readonly string[];
  /** What can be opened, in lines, if the file is of no known format. */
  readonly formats?: readonly string[];
}

/** Returns why files cannot be opened, in lines; what can be opened stands once, at the end. */
export function failureLines(failures: readonly Omit<FailedOpening, "kind">[]): readonly string[] {
  const [first, second] = failures;
  const reasons = second
    ? failures.map(({ fileName, reasons: own }) => strings.files.reason(fileName, own))
    : (first?.reasons ?? []);
  return [...reasons, ...(failures.find(({ formats }) => formats)?.formats ?? [])];
}

const projectFile = {
  description: strings.files.description,
  extensions: [".json"],
  mimeTypes: ["application/json"],
};

const isNamed = (error: unknown, name: string): boolean =>
  error instanceof DOMException && error.name === name;
const isAbort = (error: unknown): boolean => isNamed(error, "AbortError");

/** Browsers open a dialog only right after a click or a key, so its code must already be loaded. */
export const loadFileDialogs = () => Promise.all([import("browser-fs-access"), import("./mesh-formats")]);

/** The dialogs of some browsers add a handle that can be written to. */
type OpenedFile = File & { readonly handle?: FileSystemFileHandle };

/** Number of open dialogs. */
let openDialogs = 0;

const partFile = {
  description: strings.files.part,
  extensions: [".step", ".stp", ".brep", ".brp"],
  id: "tetrafront-part",
};

/** Asks for a CAD file. Returns null if the user closes the dialog. */
export async function chooseCadFile(): Promise<File | null> {
  const [{ fileOpen }] = await loadFileDialogs();
  try {
    return await fileOpen(partFile);
  } catch (error) {
    if (isAbort(error)) return null;
    throw error;
  }
}

/** Called when reading begins that may take long, with a signal to be aborted; and with null when it has ended. */
export type OnReading = (
  reading: { readonly fileName: string; readonly abort: AbortController } | null,
) => void;

/** Rank of the files of one mesh: TetGen's elements need the nodes beside them, and have the faces as patches. */
const rankOf = ({ name }: File): number => (/\.node$/i.test(name) ? 2 : /\.face$/i.test(name) ? 1 : 0);

const stemOf = ({ name }: File): string => name.replace(/\.[^.]*$/, "");

/** Returns whether a file is read with one of TetGen's other files of the same name. */
const isCompanion = (file: File, files: readonly File[]): boolean =>
  files.some(
    (other) =>
      /\.(ele|face|poly|smesh)$/i.test(other.name) &&
      stemOf(other) === stemOf(file) &&
      rankOf(other) < rankOf(file),
  );

/**
 * Reads the files that are dropped on the page together, projects first. Returns a result for each, except for those that
 * others need, such as TetGen's nodes for its elements. Reads no more if the user cancels.
 */
export async function readDroppedFiles(
  files: readonly OpenedFile[],
  onReading: OnReading,
): Promise<OpenResult[]> {
  const own = files.filter((file) => !isCompanion(file, files));
  const results: OpenResult[] = [];
  for (const file of own.sort((a, b) => Number(isProject(b.name)) - Number(isProject(a.name)))) {
    const others = files.filter((other) => other !== file);
    const result = await readDocumentFile(file, onReading, others);
    if (result.kind === "cancelled") break;
    results.push(result);
  }
  return results;
}

/** Reads a project, a surface or a mesh. `others`: files that it may need. */
export async function readDocumentFile(
  file: OpenedFile,
  onReading: OnReading,
  others: readonly File[] = [],
): Promise<OpenResult> {
  const abort = new AbortController();
  try {
    const { formatOf } = await import("./mesh-formats");
    const isMeshFile = (formatOf(file.name)?.readable.length ?? 0) > 0 && !isProject(file.name);
    if (!isMeshFile) return await (isProject(file.name) ? projectIn(file) : otherIn(file));
    onReading({ fileName: file.name, abort });
    return await contentOf(file, others, abort.signal);
  } catch (error) {
    if (abort.signal.aborted) return { kind: "cancelled" };
    // Causes are, for example, a folder, or a part of the app that could not be loaded.
    return { kind: "failed", fileName: file.name, reasons: [String(error)] };
  } finally {
    onReading(null);
  }
}

const isProject = (fileName: string): boolean => /\.json$/i.test(fileName);

async function contentOf(file: File, others: readonly File[], signal: AbortSignal): Promise<OpenResult> {
  const name = stemOf(file);
  const head = { id: 1, firstPatchId: 1, name };
  const read = await readSurfaceFile(file, others, head, signal);
  if (!read.success) return { kind: "failed", fileName: file.name, reasons: read.reasons };
  keepWhatReads(file.name);
  const { mesh } = read;
  return mesh ? { kind: "mesh", name, fileName: file.name, read, mesh } : { kind: "surface", name, read };
}

async function projectIn(file: OpenedFile): Promise<OpenResult> {
  const read = await readProjectBlob(file);
  if (read.success) {
    const { handle, lastModified } = file;
    const { name: fileName } = file;
    return { kind: "opened", fileName, project: read.value, file: handle ? { handle, lastModified } : null };
  }
  const reasons = read.errors.map(({ message, remedy, line }) =>
    strings.files.error(`${message}. ${remedy}`, line),
  );
  return { kind: "failed", fileName: file.name, reasons };
}

/** Reads a file of another extension: a project under another name; any other file is refused with what can be opened. */
async function otherIn(file: OpenedFile): Promise<OpenResult> {
  const result = await projectIn(file);
  if (result.kind !== "failed" || (await looksLikeProject(file))) return result;
  const { FILE_FORMATS } = await import("./mesh-formats");
  const readable = FILE_FORMATS.filter((format) => format.readable.length > 0);
  const isCad = (format: (typeof readable)[number]): boolean => format.isCad === true;
  const isSurface = (format: (typeof readable)[number]): boolean =>
    !isCad(format) && !format.readable.includes("volume");
  const listed = (formats: typeof readable): readonly string[] =>
    formats.flatMap(({ extensions }) => [...extensions]);
  const reasons = [strings.files.unknownFormat(/\.[^.]+$/.exec(file.name)?.[0] ?? "")];
  const formats = strings.files.knownFormats([
    listed(readable.filter(isCad)),
    listed(readable.filter(isSurface)),
    listed(readable.filter((format) => format.readable.includes("volume"))),
  ]);
  return { ...result, reasons, formats };
}

/** Bytes of a file that tell whether it may be a project. */
const headBytes = 200;

/** Returns whether a file begins like a project, whose errors then help more than a list of formats. */
const looksLikeProject = async (file: File): Promise<boolean> =>
  (await file.slice(0, headBytes).text()).trimStart().startsWith("{");

/** Asks the user for a file. A second request while the dialog is open counts as cancelled: browsers refuse it. */
export async function openDocumentFile(
  what: "documents" | "surfaces",
  onReading: OnReading,
): Promise<OpenResult> {
  openDialogs += 1;
  try {
    const [{ fileOpen }, { extensionsFor }] = await loadFileDialogs();
    const extensions = (["surface", "volume"] as const).flatMap((held) => extensionsFor("read", held));
    const meshes = {
      description: strings.files.meshDescription,
      extensions: [...new Set(extensions)].map((extension) => `.${extension.replace(/^\./, "")}`),
    };
    const all = {
      ...projectFile,
      description: strings.files.anyDescription,
      extensions: [...projectFile.extensions, ...meshes.extensions],
    };
    const file = await fileOpen(what === "surfaces" ? meshes : all);
    return await readDocumentFile(file, onReading);
  } catch (error) {
    if (isAbort(error) || (openDialogs > 1 && isNamed(error, "NotAllowedError")))
      return { kind: "cancelled" };
    throw error;
  } finally {
    openDialogs -= 1;
  }
}

/** Limit that keeps every file name, with any extension, within the 255 bytes of file systems. */
const LONGEST_STEM = 60;

/** "Engine intake" as "engine-intake". */
export function fileStem(name: string): string {
  const words = name.toLowerCase().replaceAll(/[^\p{L}\p{N}]+/gu, "-");
  const stem = Array.from(words.replace(/^-/, "")).slice(0, LONGEST_STEM).join("").replace(/-$/, "");
  return stem === "" ? "untitled" : stem;
}

/**
 * Saves to a file, or without one asks the user for it. A file that was changed on disk since this document last read
 * or wrote it is not overwritten: the user is asked for another. Returns null if the user closes the dialog.
 */
export async function saveProjectFile(
  project: Project,
  file: ProjectFile | null,
): Promise<{ readonly file: ProjectFile | null } | null> {
  try {
    const [{ fileSave }] = await loadFileDialogs();
    const handle = await fileSave(
      // Pass a promise: the browser lets the user choose a file only right after a click.
      writeProjectBlob(project),
      { ...projectFile, fileName: `${fileStem(project.name)}.json` },
      file && (await isWritable(file)) ? file.handle : null,
    );
    // Without a handle, the browser has downloaded the project.
    return { file: handle ? { handle, lastModified: (await handle.getFile()).lastModified } : null };
  } catch (error) {
    if (isAbort(error)) return null;
    throw error;
  }
}

/** A handle as Chromium has it: after a reload, the user must allow each file again. */
type AskingHandle = FileSystemFileHandle & {
  readonly requestPermission?: (options: { readonly mode: "readwrite" }) => Promise<PermissionState>;
};

async function isWritable({ handle, lastModified }: ProjectFile): Promise<boolean> {
  try {
    const permission = await (handle as AskingHandle).requestPermission?.({ mode: "readwrite" });
    return permission !== "denied" && (await handle.getFile()).lastModified === lastModified;
  } catch {
    // The file was moved or deleted.
    return false;
  }
}

/** Downloads a file. */
export function download(parts: BlobPart[], fileName: string, type: string): void {
  const url = URL.createObjectURL(new Blob(parts, { type }));
  const anchor = document.createElement("a");
  anchor.href = url;
  anchor.download = fileName;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
