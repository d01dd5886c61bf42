/** What a file format is to the rest of the package. Each has one file, named after it, and one row in file-formats.ts. */
import type { Diagnostic } from "../api/types.js";
import type { Part } from "./bytes.js";
import type { ByteSource } from "./byte-source.js";
import type { FileMesh } from "./file-mesh.js";

/** Triangles, or tetrahedra with their boundary. */
export type Contents = "surface" | "volume";

/** A name and what is to be in it, made while it is written. */
export interface FileParts {
  readonly fileName: string;
  readonly parts: Iterable<Part>;
}

/** One of the files that a mesh becomes: most formats have one, some several. */
export interface WrittenFile {
  readonly fileName: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** What the format has no place for and is not in the file, in sentences; with the first of several files. */
  readonly notes: readonly Diagnostic[];
}

/** Takes what a writer leaves out, as a sentence. */
export type Note = (message: string) => void;

/** The files beside the one that is read, by name; undefined where there is none. */
export type OpenOther = (fileName: string) => Promise<ByteSource | undefined>;

/** What a reader knows beside the bytes. */
export interface ReadContext {
  readonly fileName: string;
  readonly openOther: OpenOther;
  /** Heard between the steps of work on bytes that were read; readers of pieces hear it by their source. */
  readonly signal?: AbortSignal | undefined;
  /** For readers with an `arrival`: told the share that is done, 0 to 1, of the work that comes behind it. */
  readonly onWork?: ((fraction: number) => void) | undefined;
}

/** Rejects with an Error where the file cannot be read; `readMesh` gives code, place and remedy as a result. */
export type MeshReader = (source: ByteSource, context: ReadContext) => Promise<FileMesh>;
/** Gives the files of a mesh; the first has the name given. Throws a MesherError where the format cannot hold it. */
export type MeshWriter = (mesh: FileMesh, fileName: string, note: Note) => readonly FileParts[];

/** What reads and writes a format, once it is fetched. */
export interface FormatCode {
  readonly read?: MeshReader;
  readonly write?: MeshWriter;
  /**
   * Of readers that gather all bytes first: the share of the whole work that is done then, for the progress. They tell
   * of the rest by `onWork`.
   */
  readonly arrival?: number;
  /** How often the writer goes through the nodes and elements, roughly, where that is not about four times: its progress is estimated by that. */
  readonly passes?: number;
}

/** One format of files, as `FILE_FORMATS` lists it. */
export interface FileFormat {
  /** Short and stable, e.g. "gmsh2". */
  readonly id: string;
  /** As people call it, e.g. "Gmsh 2.2". */
  readonly name: string;
  /** In lower case with their dots; the first is the usual one. No two formats share one. */
  readonly extensions: readonly [string, ...string[]];
  /** Extensions of the files that a mesh is spread over, beside the one that is named. */
  readonly beside?: readonly string[];
  readonly reads: readonly Contents[];
  readonly writes: readonly Contents[];
  /** The code of the format, fetched when it is first needed. */
  readonly load: () => Promise<FormatCode>;
}
