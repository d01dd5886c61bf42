/** Errors of reading a file or a value as a project. */

/**
 * - `invalid-argument`: an argument is invalid, for example the source of bytes, or a file name is missing.
 * - `unknown-format`: no format that can be read, or written, as requested has the extension of the file.
 * - `unreadable-file`: the file at a path could not be opened or read.
 * - `empty-file`: the file has no bytes.
 * - `malformed-file`: the content violates its format or uses unsupported features; `line` or `offset` locates it.
 * - `too-large-file`: the file has more points or elements than can be indexed or than fit into memory.
 * - `missing-file`: the format needs another file next to this one, which was not found.
 * - `missing-library`: the library that reads CAD files could not be loaded.
 * - `no-triangles`, `no-tetrahedra`: the file contains none.
 * - `not-a-project`: neither format nor structure are those of a project.
 * - `later-version`: a project of a later version of Tetrafront.
 * - `invalid-project`: a project with an invalid value; `path` locates it.
 */
export type ReadCode =
  | "invalid-argument"
  | "unknown-format"
  | "unreadable-file"
  | "empty-file"
  | "malformed-file"
  | "too-large-file"
  | "missing-file"
  | "missing-library"
  | "no-triangles"
  | "no-tetrahedra"
  | "not-a-project"
  | "later-version"
  | "invalid-project";

/** One error in a file. */
export interface ReadError {
  readonly code: ReadCode;
  /** One sentence: the error and its location in the file. */
  readonly message: string;
  /** One sentence: what to do about it. */
  readonly remedy: string;
  /** For formats of several files, it may be another file than the given one. */
  readonly fileName?: string | undefined;
  /** Location in a project, for example `lines[3].points[1]`. */
  readonly path?: string | undefined;
  /** Location in a text file: line number from 1. */
  readonly line?: number | undefined;
  /** Location in a binary file: offset in bytes from 0. */
  readonly offset?: number | undefined;
}

/** Expected failures are values. There is at least one error if `success` is false. */
export type ReadResult<T> =
  | { readonly success: true; readonly value: T }
  | { readonly success: false; readonly errors: readonly [ReadError, ...ReadError[]] };
