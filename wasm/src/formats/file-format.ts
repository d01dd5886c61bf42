/**
 * Interface between a file format and the rest of the package. Each format has one file, named after it, and one
 * entry in file-formats.ts.
 */
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import type { ElementBlocks } from "../mesh/element-blocks.js";
import type { Mesh } from "../mesh/mesh.js";
import type { ByteSource } from "./byte-source.js";
import type { Part } from "./bytes.js";
import type { WrittenMesh } from "./second-order.js";
import type { Spool } from "./spool.js";

/** Triangles, or tetrahedra with their boundary. */
export type Contents = "surface" | "volume";

/** Name of a file, and its content, generated while it is written. */
export interface FileParts {
  readonly fileName: string;
  readonly parts: Iterable<Part>;
}

/** One of the files of a written mesh: most formats have one, some have several. */
export interface WrittenFile {
  readonly fileName: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
  /** One diagnostic per kind of content that the format cannot store; attached to the first file. */
  readonly notes: readonly Diagnostic[];
}

/** One of the files of a mesh, whose bytes are made while they are read. */
export interface StreamedFile {
  readonly fileName: string;
  /** The bytes of the file, at most 1 MB at a time. Some pieces are parts of the mesh's arrays: do not change them. */
  readonly pieces: AsyncIterable<Uint8Array>;
}

/** A mesh that is written while it is read. */
export interface StreamedMesh {
  /** Most formats have one file. Read all pieces of a file before those of the next one. */
  readonly files: readonly StreamedFile[];
  /** One diagnostic per kind of content that the format cannot store; complete when all pieces have been read. */
  readonly notes: readonly Diagnostic[];
}

/** Receives a sentence about content that a writer leaves out. */
export type Note = (message: string) => void;

/** Opens a file next to the one being read, by name; undefined if there is none. */
export type OpenOther = (fileName: string) => Promise<ByteSource | undefined>;

/** Input of a reader besides the bytes. */
export interface ReadContext {
  readonly fileName: string;
  /** Target edge length, for readers that triangulate. */
  readonly size?: number | undefined;
  readonly openOther: OpenOther;
  /** Checked between two slices of work after the bytes were read; readers of pieces are cancelled by their source. */
  readonly signal?: AbortSignal | undefined;
  /**
   * For readers with an `arrival`: called with the fraction, 0 to 1, of the work that follows the arrival of the
   * bytes.
   */
  readonly onWork?: ((fraction: number) => void) | undefined;
}

/**
 * Rejects with an Error if the file cannot be read; `readMesh` turns it into a result with code, location and
 * remedy.
 */
export type MeshReader = (source: ByteSource, context: ReadContext) => Promise<Mesh>;
/**
 * Returns the files of a mesh; the first has the given name. Throws a MesherError if the format cannot hold the
 * mesh. `createSpool`: where a writer keeps bytes that come after others that it does not know yet; by default, in memory.
 */
export type MeshWriter = (
  mesh: WrittenMesh,
  fileName: string,
  note: Note,
  createSpool?: () => Spool,
) => readonly FileParts[];

/** The boundary of a mesh with its patches and regions, and the blocks of its nodes and tetrahedra. */
export interface BlockedMesh {
  readonly mesh: Mesh;
  readonly blocks: ElementBlocks;
}

/** Yields the content of a file, in order. */
export type BlockWriter = (
  mesh: BlockedMesh,
  note: Note,
  createSpool: () => Spool,
) => AsyncGenerator<Part, void>;

/** Code of a format, loaded on demand. */
export interface FormatCode {
  readonly read?: MeshReader;
  readonly write?: MeshWriter;
  /** Writes meshes whose elements are handed out in blocks, to one file. */
  readonly writeBlocks?: BlockWriter;
  /**
   * For readers that collect all bytes first: the fraction of the total work done by then. They report the rest to
   * `onWork`.
   */
  readonly arrival?: number;
  /** Approximate number of passes of the writer over nodes and elements, for the progress estimate; 4 if omitted. */
  readonly passes?: number;
}

/** File format, as listed in `FILE_FORMATS`. */
export interface FileFormat {
  /** Short and stable, for example "gmsh2". */
  readonly id: string;
  /** Name for users, for example "Gmsh 2.2". */
  readonly name: string;
  /** In lower case, with their dots; the first is the usual one. No two formats share an extension. */
  readonly extensions: readonly [string, ...string[]];
  /** Extensions of all files of a mesh, for formats that use several files. */
  readonly companions?: readonly string[];
  /** Extension of the file beside a mesh that holds the values at its nodes; written if there are any. */
  readonly valuesExtension?: string;
  /**
   * Whether the file describes shapes, which are triangulated when they are read. The triangles are near the shapes, but
   * poor, so they are replaced before meshing unless others are asked for.
   */
  readonly isCad?: boolean;
  readonly readable: readonly Contents[];
  readonly writable: readonly Contents[];
  /** Whether second-order elements can be written. */
  readonly hasSecondOrder?: boolean;
  /** Loads the code of the format on first use. */
  readonly load: () => Promise<FormatCode>;
}
