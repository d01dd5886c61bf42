/** Errors of reading a file or a value as a project. */
import { printable } from "../diagnostics/package-diagnostic.js";

/**
 * - `invalid-argument`: an argument is invalid, for example the source of bytes, or a file name is missing.
 * - `unknown-format`: no format that can be read, or written, as requested has the extension of the file.
 * - `empty-file`: the file has no bytes.
 * - `malformed-file`: the content violates its format or uses unsupported features; `line` or `offset` locates it.
 * - `too-large-file`: the file has more points or elements than can be indexed or than fit into memory.
 * - `missing-file`: the format needs another file next to this one, which was not found.
 * - `no-triangles`, `no-tetrahedra`: the file contains none.
 * - `invalid-sizes`: the values at its nodes are not valid element sizes.
 * - `not-a-project`: neither format nor structure are those of a project.
 * - `later-version`: a project of a later version of Tetrafront.
 * - `invalid-project`: a project with an invalid value; `path` locates it.
 */
export type ReadCode =
  | "invalid-argument"
  | "unknown-format"
  | "empty-file"
  | "malformed-file"
  | "too-large-file"
  | "missing-file"
  | "no-triangles"
  | "no-tetrahedra"
  | "invalid-sizes"
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

/** Thrown inside a reader and turned into a result at its entry; callers never see it. */
export class ReadFailure extends Error {
  readonly error: ReadError;

  constructor(error: Omit<ReadError, "code"> & { readonly code?: ReadCode }) {
    super(error.message);
    this.error = { code: "malformed-file", ...error, message: printable(error.message) };
  }
}

/** Adds the file name to a read failure that has none; returns anything else unchanged. */
export function failureIn(fileName: string, failure: unknown): unknown {
  if (!(failure instanceof ReadFailure)) return failure;
  return new ReadFailure({ fileName, ...failure.error });
}

/** Failure of a file with more coordinates or corners than 32-bit indices can address. */
export function tooManyNumbers(limit: number): ReadFailure {
  const [threes, fours] = [Math.floor(limit / 3), Math.floor(limit / 4)];
  return new ReadFailure({
    code: "too-large-file",
    message: `the file has more than ${threes} points or triangles, or ${fours} tetrahedra, the limit`,
    remedy: "Split the file into parts.",
  });
}

/** Turns a failed allocation of arrays into a read failure; returns anything else unchanged. */
export function asTooLarge(failure: unknown): unknown {
  if (!(failure instanceof RangeError && /alloc|array length|buffer|maximum size/i.test(failure.message))) {
    return failure;
  }
  return new ReadFailure({
    code: "too-large-file",
    message: "the points and elements of the file do not fit into memory",
    remedy: "Use a smaller mesh, or read its parts one by one: a point takes 24 bytes, a triangle 16.",
  });
}

/** Location in a file: `line` in text, else `offset`. */
export type FileLocation = Pick<ReadError, "line" | "offset">;

/** Returns a failure at a location, with which its message begins. */
export function failureAt(location: FileLocation, message: string, remedy: string): ReadFailure {
  const words = location.line === undefined ? `byte ${location.offset ?? 0}` : `line ${location.line}`;
  return new ReadFailure({ message: `${words}: ${message}`, remedy, ...location });
}

/** Runs a reader. A ReadFailure becomes a result; anything else is our own mistake and passes through. */
export function readSafely<T>(read: () => T): ReadResult<T> {
  try {
    return { success: true, value: read() };
  } catch (failure) {
    if (failure instanceof ReadFailure) return { success: false, errors: [failure.error] };
    throw failure;
  }
}
