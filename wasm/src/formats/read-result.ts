/** Failures inside a reader, and how they become results. */
import { printable } from "../diagnostics/package-diagnostic.js";
import type { ReadCode, ReadError, ReadResult } from "../diagnostics/read-error.js";

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

const MESH_TOO_LARGE = {
  message: "the points and elements of the file do not fit into memory",
  remedy: "Use a smaller mesh, or read its parts one by one: a point takes 24 bytes, a triangle 16.",
};

/** Turns a failed allocation of arrays into a read failure; returns anything else unchanged. */
export function asTooLarge(
  failure: unknown,
  error: Pick<ReadError, "message" | "remedy"> = MESH_TOO_LARGE,
): unknown {
  if (!(failure instanceof RangeError && /alloc|array length|buffer|maximum size/i.test(failure.message))) {
    return failure;
  }
  return new ReadFailure({ code: "too-large-file", ...error });
}

/** Location in a file: `line` in text, else `offset`. */
export type FileLocation = Pick<ReadError, "line" | "offset">;

/** Returns a failure at a location, with which its message begins. */
export function failureAt(location: FileLocation, message: string, remedy: string): ReadFailure {
  const words = location.line === undefined ? `byte ${location.offset ?? 0}` : `line ${location.line}`;
  return new ReadFailure({ message: `${words}: ${message}`, remedy, ...location });
}

/** Advice for a file whose end is missing. */
const TRUNCATED_REMEDY = "Export, copy or download the file again: its end is missing.";

/** Returns a failure of a file that ends too early. `where`: what is missing, after "it ends". */
export function truncatedAt(location: FileLocation, where: string): ReadFailure {
  return failureAt(location, `the file is truncated: it ends ${where}`, TRUNCATED_REMEDY);
}

/** Runs a reader. A ReadFailure becomes a result; anything else is a bug and is rethrown. */
export function readSafely<T>(read: () => T): ReadResult<T> {
  try {
    return { success: true, value: read() };
  } catch (failure) {
    if (failure instanceof ReadFailure) return { success: false, errors: [failure.error] };
    throw failure;
  }
}
